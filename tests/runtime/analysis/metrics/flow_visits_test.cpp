#include <numbers>

#include <gtest/gtest.h>

#include "samara/analysis/metrics/sampled_falls.hpp"
#include "samara/core/dynamics/loads.hpp"
#include "support/known_bodies.hpp"

namespace samara {
namespace {

/// One body with these poses, a frame each, a second apart.
Motion motion_of(const std::vector<Pose>& poses) {
    Motion motion;
    motion.bodies.emplace_back();
    for (const Pose& pose : poses) {
        motion.times.push_back(static_cast<double>(motion.times.size()));
        motion.bodies.front().poses.push_back(pose);
    }
    return motion;
}

Pose moving(const Vector3d& velocity) {
    Pose pose;
    pose.velocity = velocity;
    return pose;
}

TEST(FlowVisits, AreTheVelocityInBodyAxes) {
    const ImmersedBody body = test::ideal_ellipsoid();
    Pose pose = moving({0.0, 0.0, -0.3});
    pose.orientation = Quaterniond(Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3d::UnitX()));
    const auto visits = flow_visits(motion_of({pose}), 0, body, {});
    ASSERT_EQ(visits.size(), 1u);
    EXPECT_LT((visits[0].direction - Vector3d(0, -1, 0)).norm(), 1e-12);
    EXPECT_NEAR(visits[0].reynolds_number, reynolds_number(body, 0.3), 1e-9);
    EXPECT_NEAR(visits[0].pressure, 0.5 * body.fluid_density * 0.09, 1e-9);
}

TEST(FlowVisits, AreRelativeToCurrentAndGust) {
    Surroundings windy;
    windy.current = Vector3d(0.2, 0.0, 0.0);
    windy.gust = {.amplitude = Vector3d(0.0, 0.1, 0.0), .period = 4.0};
    const auto visits =
        flow_visits(motion_of({moving({0.1, 0, 0}), moving({0.1, 0, 0})}), 0, test::ideal_ellipsoid(), windy);
    ASSERT_EQ(visits.size(), 2u);
    EXPECT_LT((visits[0].direction - Vector3d(-1, 0, 0)).norm(), 1e-12);
    EXPECT_LT((visits[1].direction - Vector3d(-0.1, -0.1, 0).normalized()).norm(), 1e-12);
}

TEST(FlowVisits, AreOfTheCentroidWhereTheBodyTurnsAboutItsCentreOfMass) {
    const ImmersedBody body = test::blunt_ellipsoid({0.0, 0.0, 0.004});
    Pose pose = moving({1e-3, 0.0, 0.0});
    pose.angular_velocity = Vector3d(0.0, 5.0, 0.0);
    const auto visits = flow_visits(motion_of({pose}), 0, body, {});
    const Vector3d expected = pose.velocity + pose.angular_velocity.cross(body.center_of_buoyancy);
    EXPECT_LT((visits[0].direction - expected.normalized()).norm(), 1e-12);
}

TEST(FlowVisits, LeaveOutWhatRests) {
    Surroundings windy;
    windy.current = Vector3d(0.2, 0.0, 0.0);
    // Held in the world, then carried along by the current.
    EXPECT_TRUE(
        flow_visits(motion_of({moving({0, 0, 0}), moving({0.2, 0, 0})}), 0, test::ideal_ellipsoid(), windy)
            .empty());
}

}  // namespace
}  // namespace samara
