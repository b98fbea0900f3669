#include "samara/motion/measures.hpp"

#include <gtest/gtest.h>

#include "samara/analysis/metrics/ensemble.hpp"
#include "samara/core/base/error.hpp"
#include "samara/motion/inclination.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::degree;
using test::flutter;
using test::motion_of;
using test::tumble;

Measures measures_of(const std::function<Pose(double)>& pose, double duration, double frame_rate = 60.0) {
    const Motion motion = motion_of(pose, duration, frame_rate);
    return measure(motion, motion.bodies[0]);
}

/// A repeatable ripple between -1 and 1.
double ripple(double time) {
    return std::sin(191.0 * time) * std::cos(83.0 * time + 1.0);
}

TEST(Measures, FlutterShowsItsFrequencyAmplitudeAndSpeed) {
    for (const double frequency : {0.7, 1.3, 3.1}) {
        const Measures m =
            measures_of([&](double t) { return flutter(t, frequency, 40.0 * degree, 0.21); }, 9.0);
        EXPECT_EQ(m.regime, Regime::fluttering);
        ASSERT_TRUE(m.frequency.has_value());
        EXPECT_NEAR(*m.frequency, frequency, 2e-3 * frequency);
        // |cos| stays below cos(0.05 * 90 degrees) for 95 % of the time.
        EXPECT_NEAR(m.inclination_amplitude, 40.0 * degree * std::cos(4.5 * degree), 0.2 * degree);
        EXPECT_NEAR(m.descent_speed, 0.21, 1e-12);
        EXPECT_NEAR(m.mean_velocity.y(), 0.01, 1e-12);
        EXPECT_EQ(m.turnovers, 0);
        const double rms = 40.0 * degree * 2.0 * std::numbers::pi * frequency / std::numbers::sqrt2;
        EXPECT_NEAR(m.rms_angular_speed, rms, 0.03 * rms);
    }
}

TEST(Measures, FrequencyIsFoundBetweenFrames) {
    const Measures m = measures_of([](double t) { return flutter(t, 2.2, 30.0 * degree, 0.2); }, 6.0, 24.0);
    ASSERT_TRUE(m.frequency.has_value());
    EXPECT_NEAR(*m.frequency, 2.2, 0.01);
}

TEST(Measures, RipplesBelowTheProminenceAreNoSwings) {
    const auto noisy = [](double t) {
        Pose pose = flutter(t, 1.0, 40.0 * degree, 0.2);
        pose.orientation = pose.orientation * Eigen::AngleAxisd(0.8 * degree * ripple(t), Vector3d::UnitY());
        return pose;
    };
    const Measures m = measures_of(noisy, 9.0, 240.0);
    ASSERT_TRUE(m.frequency.has_value());
    EXPECT_NEAR(*m.frequency, 1.0, 0.01);
    EXPECT_EQ(m.swings, 12);
    EXPECT_EQ(m.regime, Regime::fluttering);
}

TEST(Measures, TumblingTurnsOverTwiceInAPeriod) {
    const double spin = 7.0;
    for (const double sign : {1.0, -1.0}) {
        const Measures m = measures_of([&](double t) { return tumble(t, sign * spin, 0.4); }, 9.0);
        EXPECT_EQ(m.regime, Regime::tumbling);
        ASSERT_TRUE(m.frequency.has_value());
        EXPECT_NEAR(*m.frequency, spin / (2.0 * std::numbers::pi), 2e-3);
        EXPECT_NEAR(m.rms_angular_speed, spin, 1e-12);
        EXPECT_NEAR(m.turnovers, 6.0 * spin / std::numbers::pi, 1.0);
    }
}

TEST(Measures, SteadyFallHasNoFrequency) {
    const auto steady = [](double t) {
        Pose pose;
        pose.orientation = Eigen::AngleAxisd(20.0 * degree + 0.3 * degree * ripple(t), Vector3d::UnitX());
        pose.position.z() = -0.3 * t;
        pose.velocity.z() = -0.3;
        return pose;
    };
    const Measures m = measures_of(steady, 6.0);
    EXPECT_EQ(m.regime, Regime::steady);
    EXPECT_FALSE(m.frequency.has_value());
    EXPECT_NEAR(m.mean_inclination, 20.0 * degree, 0.1 * degree);
    EXPECT_NEAR(m.window.begin, 2.0, 1e-9);
    EXPECT_NEAR(m.window.end, 6.0, 1e-9);
}

TEST(Measures, SpinAboutTheVerticalIsAutorotation) {
    const auto samara = [](double t) {
        Pose pose;
        pose.orientation = Eigen::AngleAxisd(30.0 * t, Vector3d::UnitZ()) *
                           Eigen::AngleAxisd(15.0 * degree, Vector3d::UnitX());
        pose.angular_velocity = Vector3d(0.0, 0.0, 30.0);
        return pose;
    };
    EXPECT_EQ(measures_of(samara, 3.0).regime, Regime::autorotating);
}

TEST(Measures, TurnsInChangingSensesAreChaotic) {
    // Swings by 150 degrees to either side: turns over each time, and back.
    EXPECT_EQ(measures_of([](double t) { return flutter(t, 0.5, 150.0 * degree, 0.2); }, 12.0).regime,
              Regime::chaotic);
    // Flutters and at times turns over.
    const auto mixed = [](double t) {
        Pose pose = flutter(t, 1.0, 40.0 * degree, 0.2);
        const double turned = t - 3.0 * std::floor(t / 3.0) - 2.0;
        if (turned > 0.0) {
            pose.orientation =
                pose.orientation * Eigen::AngleAxisd(turned * std::numbers::pi, Vector3d::UnitY());
            pose.angular_velocity.y() += std::numbers::pi;
        }
        return pose;
    };
    EXPECT_EQ(measures_of(mixed, 18.0).regime, Regime::chaotic);
}

TEST(Measures, InclinationIsFoldedAndBelongsToTheShortestAxis) {
    Motion motion = motion_of([](double t) { return tumble(t, 1.0, 0.0); }, 3.0, 100.0);
    const BodyMotion& body = motion.bodies[0];
    const auto inclination_at = [&](int frame) {
        return inclination(motion, body, motion.pose(body, 0, frame, 0));
    };
    for (int frame = 0; frame < motion.frames(); ++frame) {
        const double angle = motion.times[static_cast<std::size_t>(frame)];
        EXPECT_NEAR(inclination_at(frame), std::min(angle, std::numbers::pi - angle), 1e-12);
    }
    motion.bodies[0].shortest_axis = Vector3d::UnitY();
    EXPECT_NEAR(inclination_at(77), 90.0 * degree, 1e-12);
    motion.gravity = Vector3d(0.0, 3.0, 0.0);
    EXPECT_NEAR(inclination_at(77), 0.0, 1e-12);
}

TEST(Measures, DescentIsAlongGravityAndAlongMinusZWithoutIt) {
    Motion motion = motion_of(
        [](double t) {
            Pose pose;
            pose.position = pose.velocity = Vector3d(3.0, 4.0, -5.0);
            pose.position *= t;
            return pose;
        },
        1.0);
    EXPECT_NEAR(measure(motion, motion.bodies[0]).descent_speed, 5.0, 1e-12);
    motion.gravity = Vector3d(0.0, 2.0, 0.0);
    EXPECT_NEAR(measure(motion, motion.bodies[0]).descent_speed, 4.0, 1e-12);
    motion.gravity = Vector3d::Zero();
    EXPECT_NEAR(measure(motion, motion.bodies[0]).descent_speed, 5.0, 1e-12);
}

TEST(Measures, WaitingBeforeTheStartAndRestAfterwardsAreNoFall) {
    const auto dropped = [](double t) {
        if (t < 2.0) return Pose{};
        if (t <= 5.0) return tumble(t - 2.0, 6.0, 0.5);
        Pose pose = tumble(3.0, 6.0, 0.5);
        pose.velocity = pose.angular_velocity = Vector3d::Zero();
        return pose;
    };
    const Motion motion = motion_of(dropped, 8.0);
    const TimeWindow fall = fall_of(motion, motion.bodies[0], 0, 0);
    EXPECT_NEAR(fall.begin, 2.0, 1.01 / 60.0);
    EXPECT_NEAR(fall.end, 5.0, 1.01 / 60.0);
    const Measures m = measure(motion, motion.bodies[0]);
    EXPECT_NEAR(m.window.begin, 3.0, 2.0 / 60.0);
    EXPECT_NEAR(m.descent_speed, 0.5, 0.005);
}

TEST(Measures, TakeTheWindowThatIsGiven) {
    const Motion motion = motion_of(
        [](double t) {
            Pose pose;
            pose.position.z() = -t * t;
            pose.velocity.z() = -2.0 * t;
            return pose;
        },
        4.0);
    EXPECT_NEAR(measure(motion, motion.bodies[0], 0, 0, TimeWindow{1.0, 2.0}).descent_speed, 3.0, 1e-9);
    const Measures instant = measure(motion, motion.bodies[0], 0, 0, TimeWindow{1.001, 1.002});
    EXPECT_NEAR(instant.descent_speed, 2.0, 1e-9);
    EXPECT_THROW((void)measure(motion, motion.bodies[0], 0, 0, TimeWindow{5.0, 6.0}), Error);
    EXPECT_THROW((void)measure(motion, motion.bodies[0], 0, 0, TimeWindow{2.0, 1.0}), Error);
}

TEST(Measures, OfOneFrameAreItsVelocityAndInclination) {
    const Measures m = measures_of([](double) { return flutter(0.0, 1.0, 25.0 * degree, 0.2); }, 0.0);
    EXPECT_NEAR(m.descent_speed, 0.2, 1e-12);
    EXPECT_NEAR(m.inclination_amplitude, 25.0 * degree, 1e-12);
    EXPECT_FALSE(m.frequency.has_value());
    EXPECT_EQ(m.regime, Regime::steady);
}

TEST(Measures, OfAllRunsAndCopiesAreMeansWithTheirDeviation) {
    Motion motion = motion_of([](double t) { return tumble(t, 6.0, 0.3); }, 3.0);
    const Motion other = motion_of([](double t) { return tumble(t, 6.0, 0.5); }, 3.0);
    motion.runs = 2;
    auto& poses = motion.bodies[0].poses;
    poses.insert(poses.end(), other.bodies[0].poses.begin(), other.bodies[0].poses.end());
    const BodyMeasures all = measure_all(motion, motion.bodies[0]);
    EXPECT_NEAR(all.value(Metric::descent_speed), 0.4, 1e-9);
    EXPECT_NEAR(*all.metrics[Metric::descent_speed]->deviation, 0.1 * std::numbers::sqrt2, 1e-9);
    EXPECT_EQ(all.regimes.share(Regime::tumbling), 1.0);
}

TEST(Percentile, IsLinearBetweenOrderStatistics) {
    EXPECT_EQ(percentile({3.0, 1.0, 2.0}, 50.0), 2.0);
    EXPECT_EQ(percentile({3.0, 1.0, 2.0}, 100.0), 3.0);
    EXPECT_NEAR(percentile({0.0, 10.0}, 95.0), 9.5, 1e-12);
    EXPECT_EQ(percentile({4.0}, 95.0), 4.0);
}

}  // namespace
}  // namespace samara
