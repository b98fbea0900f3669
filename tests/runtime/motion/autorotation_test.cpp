#include <gtest/gtest.h>

#include "samara/analysis/metrics/ensemble.hpp"
#include "samara/analysis/metrics/fall_metrics.hpp"
#include "samara/motion/measures.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::degree;
using test::motion_of;

/// A winged seed that turns round the vertical at `spin` (rad/s) with its wing, along x, `coning` above the
/// level, on a helix of `radius` that drifts sideways; it dives without a spin for a second first.
Pose seed(double time, double spin, double coning, double radius, double speed) {
    Pose pose;
    pose.position.z() = -speed * time;
    pose.velocity = Vector3d(0.05, 0.0, -speed);
    const double angle = spin * std::max(0.0, time - 1.0);
    pose.orientation =
        Eigen::AngleAxisd(angle, Vector3d::UnitZ()) * Eigen::AngleAxisd(-coning, Vector3d::UnitY());
    if (time < 1.0) return pose;
    pose.angular_velocity.z() = spin;
    pose.velocity += radius * spin * Vector3d(-std::sin(angle), std::cos(angle), 0.0);
    return pose;
}

Motion falling_seed(double spin, double duration = 6.0) {
    Motion motion =
        motion_of([&](double t) { return seed(t, spin, 20.0 * degree, 0.003, 0.8); }, duration, 200.0);
    motion.bodies[0].center_of_mass.x() = -0.01;  // the nut is at the end of -x
    return motion;
}

TEST(Autorotation, HasSpinConingHelixAndTheHeightLostBeforeOfEitherSense) {
    for (const double spin : {60.0, -60.0}) {
        const Motion motion = falling_seed(spin);
        const Measures measures = measure(motion, motion.bodies[0]);
        EXPECT_EQ(measures.regime, Regime::autorotating);
        ASSERT_TRUE(measures.autorotation);
        EXPECT_NEAR(measures.autorotation->spin_rate, 60.0, 1e-9);
        EXPECT_NEAR(measures.autorotation->helix_radius, 0.003, 3e-5);
        ASSERT_TRUE(measures.autorotation->coning_angle);
        EXPECT_NEAR(*measures.autorotation->coning_angle, 20.0 * degree, 1e-9);
        EXPECT_NEAR(measures.autorotation->spin_up_height, 0.8, 1e-9);
    }
}

TEST(Autorotation, OfABodyWithTwoEndsAlikeHasNoConing) {
    Motion motion = falling_seed(60.0);
    motion.bodies[0].center_of_mass.setZero();
    const auto found = measure(motion, motion.bodies[0]).autorotation;
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->coning_angle);
}

TEST(Autorotation, NeedsTwoTurnsInTheWindow) {
    // The window is the last 2 s of 3.
    const Motion fast = falling_seed(1.1 * 2.0 * std::numbers::pi, 3.0);
    EXPECT_TRUE(measure(fast, fast.bodies[0]).autorotation);
    const Motion slow = falling_seed(0.9 * 2.0 * std::numbers::pi, 3.0);
    EXPECT_FALSE(measure(slow, slow.bodies[0]).autorotation);
    EXPECT_EQ(measure(slow, slow.bodies[0]).regime, Regime::steady);
}

TEST(Autorotation, IsNotWhereMostOfTheTurningIsAboutLevelAxesOrGoesToAndFro) {
    for (const double level : {55.0, 65.0}) {
        const Motion motion = motion_of(
            [&](double t) {
                Pose pose = seed(t + 1.0, 60.0, 0.1, 0.003, 0.8);
                pose.angular_velocity.x() = level;
                return pose;
            },
            4.0, 200.0);
        EXPECT_EQ(measure(motion, motion.bodies[0]).autorotation.has_value(), level < 60.0);
    }
    const Motion to_and_fro = motion_of(
        [](double t) {
            Pose pose = seed(t + 1.0, 60.0, 0.1, 0.003, 0.8);
            pose.angular_velocity.z() *= std::sin(5.0 * t);
            return pose;
        },
        4.0, 200.0);
    EXPECT_FALSE(measure(to_and_fro, to_and_fro.bodies[0]).autorotation);
}

TEST(Autorotation, OfATumblingBodyIsNotLookedFor) {
    const Motion motion = motion_of([](double t) { return test::tumble(t, 12.0, 0.2); }, 6.0);
    EXPECT_FALSE(measure(motion, motion.bodies[0]).autorotation);
    EXPECT_FALSE(measure_all(motion, motion.bodies[0]).metrics[Metric::spin_rate]);
}

TEST(Autorotation, IsAmongTheMetricsOfAFallWithTheErrorOfItsSpin) {
    const Motion motion = motion_of(
        [](double t) {
            Pose pose = seed(t + 1.0, 60.0, 0.3, 0.003, 0.8);
            pose.angular_velocity.z() += 6.0 * std::sin(1.7 * t);
            return pose;
        },
        9.0, 200.0);
    const FallSeries record = fall_series(motion, motion.bodies[0], 0, 0, {3.0, 9.0});
    const auto spin = fall_metrics(record, 1.0).metrics[Metric::spin_rate];
    ASSERT_TRUE(spin);
    EXPECT_NEAR(spin->value, 60.0, 2.0);
    ASSERT_TRUE(spin->error);
    EXPECT_GT(*spin->error, 0.1);
    EXPECT_LT(*spin->error, 6.0);
}

}  // namespace
}  // namespace samara
