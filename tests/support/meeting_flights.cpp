#include "support/meeting_flights.hpp"

#include <algorithm>

#include "samara/core/collision/hull_pair.hpp"
#include "samara/core/flight/body_group.hpp"
#include "support/test_shapes.hpp"

namespace samara::test {
namespace {

const BodyGroup& kind_of(const Flight& flight, std::size_t index) {
    const BodyGroup* found = nullptr;
    for (const auto& kind : flight.kinds()) {
        if (kind->first() <= index) found = kind.get();
    }
    return *found;
}

CollisionHull hull_of(const Flight& flight, std::size_t index) {
    const BodyGroup& kind = kind_of(flight, index);
    const Pose pose = flight.pose(index);
    return {{&kind.batch().touching(index - kind.first()).contact_points, pose.orientation.toRotationMatrix(),
             pose.position},
            &kind.faces()};
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

FlightSettings meeting_in_vacuum(double gravity, double step) {
    FlightSettings settings;
    settings.fluid = {.density = 1e-9, .viscosity = 1e-9, .current = Vector3d::Zero(), .gust = {}};
    settings.gravity = {0.0, 0.0, -gravity};
    settings.step = step;
    settings.bodies_meet = true;
    return settings;
}

double energy_of(const Flight& flight, double gravity) {
    double energy = 0.0;
    for (std::size_t i = 0; i < flight.size(); ++i) {
        const Pose pose = flight.pose(i);
        const Vector3d turning = pose.orientation.conjugate() * pose.angular_velocity;
        energy += flight.mass(i) * (0.5 * pose.velocity.squaredNorm() + gravity * pose.position.z()) +
                  0.5 * turning.dot(flight.inertia(i) * turning);
    }
    return energy;
}

double overlap_of(const Flight& flight, std::size_t first, std::size_t second) {
    const PairSeparation apart = pair_separation(hull_of(flight, first), hull_of(flight, second), 0.0);
    return apart.overlap ? std::max(0.0, -apart.gap) : 0.0;
}

double deepest_overlap(const Flight& flight) {
    double deepest = 0.0;
    for (std::size_t i = 0; i < flight.size(); ++i) {
        for (std::size_t k = i + 1; k < flight.size(); ++k) {
            deepest = std::max(deepest, overlap_of(flight, i, k));
        }
    }
    return deepest;
}

double lowest_point(const Flight& flight, std::size_t index) {
    return hull_of(flight, index).hull.lowest(Vector3d::UnitZ());
}

}  // namespace samara::test
