// Forces and impulses of any size, on bodies light and heavy, at steps up to a film frame's.

#include <cmath>

#include <gtest/gtest.h>

#include "samara/core/simulation/simulation.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

Simulation made(double density, double step) {
    Simulation simulation({.ground = -0.5, .step = step});
    BodyPhysics physics;
    physics.mass.density = density;
    simulation.add({test::lopsided_shape(), "lopsided"}, physics, {.count = 3, .spread_angle = 1.0});
    return simulation;
}

bool is_finite(const Simulation& simulation) {
    for (std::size_t i = 0; i < simulation.size(); ++i) {
        const Pose pose = simulation.pose(i);
        const bool finite = pose.position.allFinite() && pose.velocity.allFinite() &&
                            pose.angular_velocity.allFinite() &&
                            std::abs(pose.orientation.norm() - 1.0) < 1e-9;
        if (!finite) return false;
    }
    return true;
}

/// Pushes the bodies about for two seconds; returns false where a motion left the range of numbers, which the
/// simulation must report.
bool survives(double density, double step, double size) {
    Simulation simulation = made(density, step);
    try {
        for (int frame = 1; frame <= 48; ++frame) {
            const double sign = frame % 2 == 0 ? 1.0 : -1.0;
            simulation.add_wrench(0, {.force = sign * size * Vector3d(1.0, 0.3, -0.2)});
            simulation.add_wrench(1, {.moment = 0.04 * sign * size * Vector3d(0.2, -1.0, 0.5)});
            simulation.add_impulse(2, {.force = 0.01 * sign * size * Vector3d(0.0, 1.0, 0.1),
                                       .moment = 1e-4 * size * Vector3d(1.0, 0.0, 0.3)});
            simulation.advance_to(frame / 24.0);
            EXPECT_TRUE(is_finite(simulation))
                << size << " N on " << density << " kg/m^3 at " << step << " s";
        }
    } catch (const SimulationError& lost) {
        EXPECT_EQ(lost.reason(), SimulationError::Reason::out_of_range);
        return false;
    }
    return true;
}

TEST(HostForceStability, ForcesUpToAThousandTimesTheWeightLeaveTheMotionFinite) {
    for (const double density : {1.2, 900.0, 1200.0, 11340.0}) {
        for (const double step : {0.0005, 0.002, 1.0 / 24.0}) {
            for (const double size : {1e-300, 1e-6, 0.3, 300.0}) EXPECT_TRUE(survives(density, step, size));
        }
    }
}

TEST(HostForceStability, ForcesBeyondAllReasonAreFlownOrRefusedAndNeverHang) {
    for (const double size : {1e6, 1e12, 1e30}) {
        for (const double step : {0.002, 1.0 / 24.0}) survives(1200.0, step, size);
    }
}

TEST(HostForceStability, AForceThatOpposesTheMotionSlowsABody) {
    for (const double step : {0.002, 1.0 / 24.0}) {
        Simulation simulation = made(1200.0, step);
        simulation.advance_to(1.0);
        const double speed = simulation.pose(0).velocity.norm();
        for (int frame = 1; frame <= 240; ++frame) {
            simulation.add_wrench(0, {.force = -0.2 * simulation.pose(0).velocity +
                                               Vector3d(0.0, 0.0, 9.81 * (simulation.mass(0) - 0.03345))});
            simulation.advance_to(1.0 + frame / 24.0);
        }
        EXPECT_LT(simulation.pose(0).velocity.norm(), 0.5 * speed) << step;
    }
}

}  // namespace
}  // namespace samara
