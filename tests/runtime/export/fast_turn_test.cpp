#include "samara/export/fast_turn.hpp"

#include <numbers>

#include <gtest/gtest.h>

#include "synthetic_motion.hpp"

namespace samara {
namespace {

TEST(FastTurn, IsTheAngularVelocityOverTheFrameRateOfTheFastestBody) {
    const auto spinning = [](double turns_a_second) {
        return [turns_a_second](double time) {
            Pose pose;
            pose.angular_velocity = Vector3d(0.0, 0.0, 2.0 * std::numbers::pi * turns_a_second);
            pose.orientation = Eigen::AngleAxisd(pose.angular_velocity.z() * time, Vector3d::UnitZ());
            return pose;
        };
    };
    Motion motion = test::motion_of(spinning(18.0), 1.0, 24.0);
    motion.bodies.push_back(test::motion_of(spinning(3.0), 1.0, 24.0).bodies[0]);
    motion.bodies[0].name = "seed";
    motion.bodies[1].name = "leaf";
    const FastTurn fastest = fastest_turn(motion, 0);
    EXPECT_EQ(fastest.body, "seed");
    EXPECT_NEAR(fastest.turns, 0.75, 1e-12);
}

}  // namespace
}  // namespace samara
