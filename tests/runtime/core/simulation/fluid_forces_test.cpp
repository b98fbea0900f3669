// The fluid's forces on a body by their causes: that they are those which move it.
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

#include "samara/core/simulation/body_group.hpp"
#include "samara/core/simulation/simulation.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

constexpr double gravity = 9.81;

BodyPhysics physics(double density, Loads loads) {
    BodyPhysics result = test::scene_body(density);
    result.loads = loads;
    result.turbulence = Turbulence::none;
    return result;
}

LoadedBody lopsided() {
    return {test::lopsided_shape(), "lopsided"};
}

/// The wrench that moves the mass of the body alone between two of its poses, less weight (world axes).
Wrench needed(const Simulation& simulation, const Pose& before, const Pose& after, double duration) {
    const auto angular_momentum = [&](const Pose& pose) {
        const Matrix3d rotation = pose.orientation.toRotationMatrix();
        return Vector3d(rotation * simulation.inertia(0) * rotation.transpose() * pose.angular_velocity);
    };
    const double mass = simulation.mass(0);
    return {mass * ((after.velocity - before.velocity) / duration + gravity * Vector3d::UnitZ()),
            (angular_momentum(after) - angular_momentum(before)) / duration};
}

/// The largest difference, over the whole force and moment of a tumbling fall, of the sum of the forces from
/// what moves the body's own mass.
double newtons_error(double step, double size, bool noisy) {
    BodyPhysics given = physics(1500.0, Loads::table);
    if (noisy) given.turbulence = Turbulence::table;
    Simulation simulation({.step = step});
    Release release;
    release.angular_velocity = Vector3d(4.0, -3.0, 6.0) / (size * size);
    release.velocity = Vector3d(0.2, 0.1, -0.3) / size;
    release.smallest_size = release.largest_size = size;
    simulation.add(lopsided(), given, release);
    double worst = 0.0;
    double force = 0.0;
    double moment = 0.0;
    Pose before = simulation.pose(0);
    for (int i = 1; i * step < 0.2; ++i) {
        simulation.advance_to(i * step);
        const Wrench at_begin = simulation.fluid_forces(0).total();
        const Pose here = simulation.pose(0);
        const Wrench moves = needed(simulation, before, here, step);
        before = here;
        force = std::max(force, moves.force.norm());
        moment = std::max(moment, moves.moment.norm());
        worst = std::max({worst, (at_begin.force - moves.force).norm() / force,
                          (at_begin.moment - moves.moment).norm() / moment});
    }
    return worst;
}

TEST(FluidForces, MoveTheBodysOwnMassByNewtonsLawToFirstOrderOfTheStep) {
    const double coarse = newtons_error(0.002, 1.0, false);
    const double fine = newtons_error(0.0005, 1.0, false);
    EXPECT_LT(fine, 0.02);
    EXPECT_NEAR(coarse / fine, 4.0, 1.0);
    EXPECT_LT(newtons_error(0.0005, 1.7, false), 0.02);
}

TEST(FluidForces, OfABodyThatIsReleasedAreItsAddedMassAndItsBuoyancy) {
    Simulation simulation({.step = 1e-4});
    simulation.add({test::exact_sphere(0.02), "sphere"}, physics(1500.0, Loads::none), {});
    simulation.advance_to(1e-4);
    const ImmersedBody& body = simulation.groups()[0]->body();
    const double displaced = body.fluid_density * body.volume;
    const double acceleration = gravity * (body.mass - displaced) / (body.mass + 0.5 * displaced);
    const FluidForces forces = simulation.fluid_forces(0);
    EXPECT_NEAR(forces.buoyancy.force.z(), gravity * displaced, 1e-9);
    EXPECT_NEAR(forces.inertia.force.z(), 0.5 * displaced * acceleration, 1e-9);
    EXPECT_TRUE(forces.drag.is_zero() && forces.lift.is_zero() && forces.noise.is_zero());
}

TEST(FluidForces, OfAFallAtItsTerminalSpeedAreBuoyancyAndADragThatBearTheWeight) {
    Simulation simulation;
    simulation.add({test::rubber_ellipsoid(), "ellipsoid"}, physics(1200.0, Loads::coefficients), {});
    simulation.advance_to(4.0);
    const FluidForces forces = simulation.fluid_forces(0);
    EXPECT_NEAR((forces.drag.force + forces.buoyancy.force).z(), gravity * simulation.mass(0), 1e-6);
    EXPECT_LT(forces.inertia.force.norm(), 1e-6);
    EXPECT_TRUE(forces.drag.moment.isZero(0.0));
    EXPECT_LT(forces.lift.force.norm(), 1e-9);
}

TEST(FluidForces, SplitTheLoadsAgainstAndAcrossThePath) {
    Simulation simulation;
    simulation.add(lopsided(), physics(1500.0, Loads::table), {.velocity = Vector3d(0.1, 0.2, -0.4)});
    simulation.advance_to(0.1);
    const FluidForces forces = simulation.fluid_forces(0);
    const ImmersedBody& body = simulation.groups()[0]->body();
    const Pose pose = simulation.pose(0);
    const Vector3d centroid =
        pose.velocity + pose.angular_velocity.cross(pose.orientation * body.center_of_buoyancy);
    EXPECT_LT(forces.drag.force.dot(centroid), 0.0);
    EXPECT_LT(forces.drag.force.cross(centroid).norm(), 1e-9 * centroid.norm());
    EXPECT_LT(std::abs(forces.lift.force.dot(centroid)), 1e-9 * centroid.norm());
    EXPECT_GT(forces.lift.force.norm(), 0.01 * forces.drag.force.norm());
}

TEST(FluidForces, TheNoiseIsTheDifferenceThatTheTurbulenceMakes) {
    BodyPhysics given = physics(1500.0, Loads::table);
    Simulation calm;
    calm.add(lopsided(), given, {});
    given.turbulence = Turbulence::table;
    Simulation turbulent;
    turbulent.add(lopsided(), given, {});
    for (Simulation* simulation : {&calm, &turbulent}) simulation->advance_to(1.0);
    EXPECT_TRUE(calm.fluid_forces(0).noise.is_zero());
    const FluidForces forces = turbulent.fluid_forces(0);
    EXPECT_GT(forces.noise.force.norm(), 1e-3 * forces.drag.force.norm());
    // Their sum is the load of a host, with the acceleration of the last step.
    const FluidLoad load = turbulent.fluid_load(0);
    const Wrench sum = forces.total();
    Vector6d acceleration;
    const Vector3d moment = load.wrench.head<3>() - sum.moment;
    const Vector3d force = load.wrench.tail<3>() - sum.force;
    acceleration << moment, force;
    acceleration = load.added_inertia.ldlt().solve(acceleration);
    const double before = turbulent.time() - 0.002;
    Simulation earlier;
    earlier.add(lopsided(), given, {});
    earlier.advance_to(before);
    const Pose was = earlier.pose(0);
    const Pose is = turbulent.pose(0);
    EXPECT_LT((acceleration.tail<3>() - (is.velocity - was.velocity) / 0.002).norm(),
              0.05 * acceleration.tail<3>().norm());
}

TEST(FluidForces, OfABodyThatWaitsOrIsRemovedAreNone) {
    Simulation simulation;
    simulation.add(lopsided(), physics(1500.0, Loads::table), {.start = 0.5});
    simulation.advance_to(0.3);
    EXPECT_TRUE(simulation.fluid_forces(0).total().is_zero());
    simulation.advance_to(0.8);
    EXPECT_FALSE(simulation.fluid_forces(0).total().is_zero());
    simulation.remove(0);
    EXPECT_TRUE(simulation.fluid_forces(0).total().is_zero());
}

}  // namespace
}  // namespace samara
