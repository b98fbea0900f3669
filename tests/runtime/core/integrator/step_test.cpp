#include "samara/core/integrator/step.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/compared_states.hpp"
#include "support/known_bodies.hpp"
#include "support/reference_step.hpp"

namespace samara {
namespace {

/// How far (m) the motions of a body that reaches 5 cm are apart, with the difference of all velocities over
/// 0.1 s.
double distance(const BodyState& a, const BodyState& b) {
    return (a.position - b.position).norm() + 0.05 * a.orientation.angularDistance(b.orientation) +
           0.1 * (a.velocity - b.velocity).norm();
}

const Vector3d gravity(0.0, 0.0, -9.81);

BodyState flown(const ImmersedBody& body, BodyState state, double time, int steps,
                const Vector3d& weight = gravity) {
    for (int i = 0; i < steps; ++i) state = implicit_step(body, weight, time / steps, state);
    return state;
}

TEST(ImplicitStep, IsOfSecondOrderWithLoadsOffsetMassAndSeenFluid) {
    for (const ImmersedBody& body : {test::blunt_ellipsoid(Vector3d(0.002, 0.001, -0.004)),
                                     test::lopsided_body(Vector3d(0.002, 0.001, -0.004))}) {
        BodyState start = test::tumbling_state(0.2, 5.0);
        start.sampled_turbulence = {Vector3d(0.05, -0.02, 0.03), Vector3d(0.5, 0.2, -0.1)};
        // Within one cell of the tables: their bilinear maps have kinks at the cells' edges.
        const double time = 0.02;
        const BodyState exact = flown(body, start, time, 4096);
        double before = distance(flown(body, start, time, 16), exact);
        for (const int steps : {32, 64, 128}) {
            const double error = distance(flown(body, start, time, steps), exact);
            EXPECT_NEAR(std::log2(before / error), 2.0, 0.15) << steps << " steps";
            before = error;
        }
    }
}

TEST(ImplicitStep, KeepsTheEnergyOfFreeMotionToRounding) {
    const ImmersedBody body = test::ideal_ellipsoid();
    BodyState state = test::tumbling_state(0.5, 100.0);
    const double energy = kinetic_energy(body, state);
    for (int i = 0; i < 1000; ++i) {
        state = implicit_step(body, Vector3d::Zero(), 1.0 / 24.0, state);
        ASSERT_NEAR(kinetic_energy(body, state) / energy, 1.0, 1e-10) << "step " << i;
    }
}

TEST(ImplicitStep, KeepsKineticPlusPotentialEnergyUnderGravity) {
    SceneBody given = test::scene_body(0.0);
    const Body shape = test::rubber_ellipsoid();
    given.loads = Loads::none;
    given.mass = {
        .density = {}, .mass = 0.04, .center_of_mass = Vector3d(0.001, 0.002, -0.003), .inertia = {}};
    const ImmersedBody body = make_immersed_body(shape, given, Fluid{});
    const auto energy = [&](const BodyState& state) {
        const Vector3d centroid = state.position + state.orientation * body.center_of_buoyancy;
        return kinetic_energy(body, state) - body.mass * gravity.dot(state.position) +
               body.fluid_density * body.volume * gravity.dot(centroid);
    };
    const BodyState start = test::tumbling_state(0.2, 3.0);
    const double scale = kinetic_energy(body, start);
    // Of the second order, since the body's rotation is found by passes: a quarter of the error at half the
    // step.
    const double coarse = std::abs(energy(flown(body, start, 1.0, 1000)) - energy(start)) / scale;
    const double fine = std::abs(energy(flown(body, start, 1.0, 2000)) - energy(start)) / scale;
    EXPECT_LT(coarse, 1e-4);
    EXPECT_LT(fine, 0.3 * coarse);
}

TEST(ImplicitStep, KeepsTheMomentaOfFreeMotionInSpaceToSecondOrderAtLeast) {
    const ImmersedBody body = test::ideal_ellipsoid();
    const BodyState start = test::tumbling_state(0.3, 6.0);
    const auto linear_momentum = [&](const BodyState& state) -> Vector3d {
        return state.orientation * (body.inertia * state.velocity).tail<3>();
    };
    const auto angular_momentum = [&](const BodyState& state) -> Vector3d {
        return state.orientation * (body.inertia * state.velocity).head<3>() +
               state.position.cross(linear_momentum(state));
    };
    double errors[2][2];
    for (int i = 0; i < 2; ++i) {
        const BodyState end = flown(body, start, 1.0, 800 << i, Vector3d::Zero());
        errors[i][0] = (linear_momentum(end) - linear_momentum(start)).norm() / linear_momentum(start).norm();
        errors[i][1] =
            (angular_momentum(end) - angular_momentum(start)).norm() / angular_momentum(start).norm();
    }
    for (const int momentum : {0, 1}) {
        EXPECT_LT(errors[0][momentum], 0.01);
        EXPECT_GT(std::log2(errors[0][momentum] / errors[1][momentum]), 1.8);
    }
}

TEST(ImplicitStep, ReachesTheTerminalSpeedOfASphereAtAnyStep) {
    const Body sphere = test::exact_sphere(0.01);
    SceneBody given = test::scene_body(0.001 * 998.2);
    given.loads = Loads::coefficients;
    given.coefficients = {.drag_coefficient = 0.47,
                          .lift_coefficient = 0.0,
                          .reference_area = std::numbers::pi * 1e-4,
                          .normal = {},
                          .center_of_pressure = Vector3d::Zero()};
    for (const double density_ratio : {0.001, 1.2, 8.0}) {
        given.mass.density = density_ratio * 998.2;
        const ImmersedBody body = make_immersed_body(sphere, given, Fluid{});
        const double weight = (density_ratio - 1.0) * 998.2 * sphere.moments.volume * 9.81;
        const double terminal = std::sqrt(std::abs(weight) / (0.5 * 998.2 * 0.47 * std::numbers::pi * 1e-4));
        for (const double step : {0.001, 1.0 / 24.0, 1.0}) {
            const int steps = std::max(1000, static_cast<int>(10.0 / step));
            const BodyState end = flown(body, {}, step * steps, steps);
            EXPECT_NEAR(end.velocity.tail<3>().norm() / terminal, 1.0, 1e-6)
                << density_ratio << " at a step of " << step;
            EXPECT_EQ(end.velocity[5] > 0.0, density_ratio < 1.0);
        }
    }
}

TEST(ImplicitStep, ABodyAtLowReynoldsNumberFallsAtTheStokesSpeed) {
    Body sphere = test::exact_sphere(1e-5);
    sphere.tables = test::blunt_tables(sphere, 2);
    for (LoadEntry& entry : sphere.tables->entries) entry.moment.setZero();
    const ImmersedBody body = make_immersed_body(sphere, test::scene_body(1200.0), Fluid{});
    const BodyState end = flown(body, {}, 0.1, 1000);
    const double stokes = 2.0 / 9.0 * (1200.0 - 998.2) * 9.81 * 1e-10 / body.viscosity;
    EXPECT_NEAR(end.velocity.tail<3>().norm() / stokes, 1.0, 0.01);
}

TEST(ImplicitStep, BuoyancyTurnsABottomHeavyBodyUprightLikeAPendulum) {
    // Neutrally buoyant, heavy end down by 4 mm: a pendulum of stiffness rho V g r and inertia J.
    const Body shape = test::rubber_ellipsoid();
    SceneBody given = test::scene_body(0.0);
    given.loads = Loads::none;
    const double mass = 998.2 * shape.moments.volume;
    given.mass = {.density = {}, .mass = mass, .center_of_mass = Vector3d(0, 0, -0.004), .inertia = {}};
    const ImmersedBody body = make_immersed_body(shape, given, Fluid{});
    // Free to move, the body swings about a point of its own: the effective inertia is the inverse of the
    // mobility's entry.
    const double inertia = 1.0 / body.inertia.inverse()(0, 0);
    const double period = 2.0 * std::numbers::pi * std::sqrt(inertia / (mass * 9.81 * 0.004));
    BodyState state;
    state.orientation = Quaterniond(Eigen::AngleAxisd(0.02, Vector3d::UnitX()));
    double first_upright = 0.0;
    const double h = period / 2000.0;
    for (int i = 1; i < 2000 && first_upright == 0.0; ++i) {
        const double before = state.orientation.x();
        state = implicit_step(body, gravity, h, state);
        if (state.orientation.x() <= 0.0) {
            first_upright = h * (i - state.orientation.x() / (state.orientation.x() - before));
        }
    }
    EXPECT_NEAR(first_upright / (period / 4.0), 1.0, 1e-3);
}

TEST(ImplicitStep, ABottomHeavyBodyWithLoadsComesToRestUpright) {
    const Body shape = test::rubber_ellipsoid();
    SceneBody given = test::scene_body(0.0);
    Body baked = shape;
    baked.tables = test::blunt_tables(shape, 4);
    given.mass = {.density = {},
                  .mass = 998.2 * shape.moments.volume,
                  .center_of_mass = Vector3d(0, 0, -0.004),
                  .inertia = {}};
    const ImmersedBody body = make_immersed_body(baked, given, Fluid{});
    BodyState state;
    state.orientation = Quaterniond(Eigen::AngleAxisd(2.5, Vector3d(1, 1, 0).normalized()));
    state = flown(body, state, 60.0, 30'000);
    const Vector3d up = state.orientation * Vector3d::UnitZ();
    EXPECT_GT(up.z(), std::cos(0.02));
}

TEST(Advance, SubstepsOnlyWhereTheBodyTurnsFastAndSaysSo) {
    const ImmersedBody body = test::blunt_ellipsoid();
    const Noise noise(1, "body", 0, 0);
    EXPECT_EQ(
        advance(body, {.gravity = gravity}, 0.0, 0.001, test::tumbling_state(0.1, 1.0), noise, 0).substeps,
        1);
    EXPECT_GT(advance(body, {.gravity = gravity}, 0.0, 1.0 / 24.0, test::tumbling_state(0.1, 100.0), noise, 0)
                  .substeps,
              10);
    EXPECT_EQ(
        advance(body, {.gravity = gravity}, 0.0, 1.0, test::tumbling_state(0.1, 1e6), noise, 0).substeps,
        most_substeps);
}

}  // namespace
}  // namespace samara
