#include "support/colliding_bodies.hpp"

#include <algorithm>

#include "samara/core/collision/hull_pair.hpp"
#include "samara/core/simulation/body_group.hpp"
#include "support/test_shapes.hpp"

namespace samara::test {
namespace {

const BodyGroup& kind_of(const Simulation& simulation, std::size_t index) {
    const BodyGroup* found = nullptr;
    for (const auto& group : simulation.groups()) {
        if (group->first() <= index) found = group.get();
    }
    return *found;
}

CollisionHull hull_of(const Simulation& simulation, std::size_t index) {
    const BodyGroup& group = kind_of(simulation, index);
    const Pose pose = simulation.pose(index);
    return {{&group.batch().touching(index - group.first()).contact_points,
             pose.orientation.toRotationMatrix(), pose.position},
            &group.faces()};
}

}  // namespace

LoadedBody body_of(const Surface& surface) {
    Body body;
    body.name = "body";
    body.surface = surface;
    body.moments = moments_of(surface);
    return {body, ""};
}

BodyPhysics without_fluid(double density) {
    BodyPhysics physics;
    physics.mass.density = density;
    physics.loads = Loads::none;
    physics.turbulence = Turbulence::none;
    physics.added_mass = false;
    return physics;
}

SimulationSettings colliding_in_vacuum(double gravity, double step) {
    SimulationSettings settings;
    settings.fluid = {.density = 1e-9, .viscosity = 1e-9, .current = Vector3d::Zero(), .gust = {}};
    settings.gravity = {0.0, 0.0, -gravity};
    settings.step = step;
    settings.bodies_collide = true;
    return settings;
}

double energy_of(const Simulation& simulation, double gravity) {
    double energy = 0.0;
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        const Pose pose = simulation.pose(i);
        const Vector3d turning = pose.orientation.conjugate() * pose.angular_velocity;
        energy += simulation.mass(i) * (0.5 * pose.velocity.squaredNorm() + gravity * pose.position.z()) +
                  0.5 * turning.dot(simulation.inertia(i) * turning);
    }
    return energy;
}

double overlap_of(const Simulation& simulation, std::size_t first, std::size_t second) {
    const PairSeparation apart =
        pair_separation(hull_of(simulation, first), hull_of(simulation, second), 0.0);
    return apart.overlap ? std::max(0.0, -apart.gap) : 0.0;
}

double deepest_overlap(const Simulation& simulation) {
    double deepest = 0.0;
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        for (std::size_t k = i + 1; k < simulation.size(); ++k) {
            deepest = std::max(deepest, overlap_of(simulation, i, k));
        }
    }
    return deepest;
}

double lowest_point(const Simulation& simulation, std::size_t index) {
    return hull_of(simulation, index).hull.lowest(Vector3d::UnitZ());
}

}  // namespace samara::test
