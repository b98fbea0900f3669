#include "samara/analysis/metrics/fall_metrics.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "irregular_flutter.hpp"
#include "samara/analysis/metrics/fall_series.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::degree;

FallSeries record_of(const Motion& motion, double begin, double end) {
    return fall_series(motion, motion.bodies[0], 0, 0, {begin, end});
}

FallMetrics metrics_of(const Motion& motion, double begin, double end) {
    return fall_metrics(record_of(motion, begin, end), std::min(end - begin, 8.0));
}

Estimate metric(const FallMetrics& metrics, Metric which) {
    return metrics.metrics.at(static_cast<std::size_t>(which)).value();
}

double error(const FallMetrics& metrics, Metric which) {
    return metric(metrics, which).error.value();
}

Motion flutter(double frequency, double amplitude, double speed, double duration) {
    return test::motion_of([=](double t) { return test::flutter(t, frequency, amplitude, speed); }, duration,
                           120.0);
}

TEST(FallMetrics, AreThoseOfMeasures) {
    const Motion motion = test::irregular_flutter(3, 12.0);
    const Measures m = measure(motion, motion.bodies[0], 0, 0, TimeWindow{4.0, 12.0});
    const FallMetrics metrics = metrics_of(motion, 4.0, 12.0);
    EXPECT_EQ(metric(metrics, Metric::descent_speed).value, m.descent_speed);
    EXPECT_EQ(metric(metrics, Metric::frequency).value, m.frequency.value());
    EXPECT_EQ(metric(metrics, Metric::inclination_amplitude).value, m.inclination_amplitude);
    EXPECT_EQ(metric(metrics, Metric::mean_inclination).value, m.mean_inclination);
    EXPECT_EQ(metric(metrics, Metric::rms_angular_speed).value, m.rms_angular_speed);
}

TEST(FallMetrics, OfARegularFlutterAreKnownAndNearlyWithoutError) {
    const FallMetrics metrics = metrics_of(flutter(1.3, 40.0 * degree, 0.21, 9.0), 3.0, 9.0);
    EXPECT_NEAR(metric(metrics, Metric::frequency).value, 1.3, 1e-3);
    EXPECT_LT(error(metrics, Metric::frequency), 1e-4);
    EXPECT_NEAR(metric(metrics, Metric::spectral_frequency).value, 1.3, 0.005);
    EXPECT_LT(error(metrics, Metric::spectral_frequency), 0.01);
    EXPECT_NEAR(metric(metrics, Metric::inclination_amplitude).value, 40.0 * degree * std::cos(4.5 * degree),
                0.2 * degree);
    EXPECT_LT(error(metrics, Metric::inclination_amplitude), 0.1 * degree);
    EXPECT_LT(error(metrics, Metric::descent_speed), 1e-12);
    // 0.05 m to and fro and 0.01 m/s on.
    EXPECT_NEAR(metric(metrics, Metric::drift_speed).value, 0.01, 0.02);
    EXPECT_LT(error(metrics, Metric::drift_speed), 0.002);
}

TEST(FallMetrics, TheSpectrumFindsTumblingAtItsTurnsPerSecond) {
    const Motion motion = test::motion_of([](double t) { return test::tumble(t, 8.0, 0.4); }, 6.0);
    EXPECT_NEAR(metric(metrics_of(motion, 2.0, 6.0), Metric::spectral_frequency).value,
                8.0 / (2.0 * std::numbers::pi), 0.01);
}

TEST(FallMetrics, ThePathSpreadIsTheRmsDistanceFromTheRelease) {
    const auto drifting = [](double t) {
        Pose pose = test::flutter(t, 1.3, 30.0 * degree, 0.2);
        pose.position = Vector3d(0.03 * t + 7.0, 0.04 * t - 3.0, -0.2 * t + 1.0);
        return pose;
    };
    const FallMetrics metrics = metrics_of(test::motion_of(drifting, 6.0, 240.0), 2.0, 6.0);
    EXPECT_NEAR(metric(metrics, Metric::path_spread).value, 0.05 * std::sqrt((216.0 - 8.0) / 12.0), 1e-4);
    EXPECT_NEAR(metric(metrics, Metric::drift_speed).value, 0.05, 1e-12);
    EXPECT_LT(error(metrics, Metric::path_spread), 1e-9);
}

TEST(FallMetrics, ErrorsMatchTheScatterBetweenFallsOfIndependentSwings) {
    constexpr int falls = 60;
    std::vector<FallMetrics> metrics;
    for (unsigned seed = 1; seed <= falls; ++seed) {
        metrics.push_back(metrics_of(test::irregular_flutter(seed, 12.0), 2.0, 12.0));
    }
    for (const Metric which : {Metric::descent_speed, Metric::frequency, Metric::mean_inclination,
                               Metric::rms_angular_speed, Metric::inclination_amplitude}) {
        double sum = 0.0;
        double squares = 0.0;
        double errors = 0.0;
        for (const FallMetrics& one : metrics) {
            const double value = metric(one, which).value;
            sum += value;
            squares += value * value;
            errors += std::pow(error(one, which), 2);
        }
        const double scatter = std::sqrt((squares - sum * sum / falls) / (falls - 1));
        // 60 falls tell a deviation to 9 %, and their errors theirs to about as much.
        EXPECT_NEAR(std::sqrt(errors / falls) / scatter, 1.0, 0.35) << static_cast<int>(which);
    }
}

TEST(FallMetrics, ErrorsHalveInAFourTimesLongerWindow) {
    constexpr std::array<Metric, 3> checked = {Metric::descent_speed, Metric::frequency,
                                               Metric::mean_inclination};
    std::array<double, 3> long_squares{};
    std::array<double, 3> short_squares{};
    for (unsigned seed = 1; seed <= 30; ++seed) {
        const Motion motion = test::irregular_flutter(seed, 50.0);
        const FallMetrics short_window = metrics_of(motion, 2.0, 14.0);
        const FallMetrics long_window = metrics_of(motion, 2.0, 50.0);
        for (std::size_t i = 0; i < checked.size(); ++i) {
            short_squares[i] += std::pow(error(short_window, checked[i]), 2);
            long_squares[i] += std::pow(error(long_window, checked[i]), 2);
        }
    }
    for (std::size_t i = 0; i < checked.size(); ++i) {
        EXPECT_NEAR(std::sqrt(long_squares[i] / short_squares[i]), 0.5, 0.1) << i;
    }
}

TEST(FallMetrics, TooFewSwingsTellNoError) {
    const FallMetrics metrics = metrics_of(test::irregular_flutter(1, 3.0), 1.0, 2.0);
    EXPECT_FALSE(metric(metrics, Metric::descent_speed).error.has_value());
    EXPECT_FALSE(metric(metrics, Metric::inclination_amplitude).error.has_value());
}

TEST(FallMetrics, ASteadyFallHasNoFrequencyAndErrorsByItsLengthsOfTime) {
    const auto sinking = [](double t) {
        Pose pose;
        pose.position.z() = -0.3 * t;
        pose.velocity.z() = -0.3;
        return pose;
    };
    const FallMetrics metrics = metrics_of(test::motion_of(sinking, 4.0), 1.0, 4.0);
    EXPECT_FALSE(metrics.metrics[static_cast<std::size_t>(Metric::frequency)].has_value());
    EXPECT_EQ(metrics.pieces, 8U);
    EXPECT_NEAR(error(metrics, Metric::descent_speed), 0.0, 1e-12);
}

TEST(FirstSwing, HasItsTurningPointsAtTheirTimes) {
    // Released at 40 degrees: through 0 after a quarter of a period, back at 40 degrees after a half.
    const FirstSwing swing = first_swing(record_of(flutter(1.3, 40.0 * degree, 0.2, 4.0), 1.0, 4.0));
    ASSERT_TRUE(swing.minimum && swing.maximum);
    EXPECT_NEAR(swing.minimum->time.value, 0.25 / 1.3, 1e-3);
    EXPECT_NEAR(swing.minimum->inclination.value, 0.0, 1.5 * degree);
    EXPECT_NEAR(swing.maximum->time.value, 0.5 / 1.3, 1e-3);
    EXPECT_NEAR(swing.maximum->inclination.value, 40.0 * degree, 0.1 * degree);
    EXPECT_NEAR(end_of(swing).value(), 0.5 / 1.3, 1e-3);
}

TEST(FirstSwing, PathsThatPartAtASpeedAreApartByItsRms) {
    const auto moving = [](double speed) {
        return test::motion_of(
            [speed](double t) {
                Pose pose = test::flutter(t, 1.3, 40.0 * degree, 0.2);
                pose.position += Vector3d(5.0, speed * t, 2.0);
                pose.velocity.y() += speed;
                return pose;
            },
            3.0, 240.0);
    };
    const double distance =
        path_distance(record_of(moving(0.3), 1.0, 3.0), record_of(moving(0.0), 1.0, 3.0), 0.5);
    EXPECT_NEAR(distance, 0.3 * 0.5 / std::sqrt(3.0), 1e-3);
}

TEST(FallSeries, CountsFromTheReleaseOfABodyThatWaits) {
    const auto late = [](double t) {
        if (t < 1.0) return Pose{Vector3d(1.0, 2.0, 3.0)};
        Pose pose = test::flutter(t - 1.0, 1.3, 40.0 * degree, 0.2);
        pose.position += Vector3d(1.0, 2.0, 3.0);
        return pose;
    };
    const FallSeries record = record_of(test::motion_of(late, 5.0), 1.0, 4.0);
    EXPECT_NEAR(record.release, 1.0, 0.02);
    EXPECT_EQ(record.times.front(), 0.0);
    EXPECT_TRUE(record.displacements.front().isZero());
    EXPECT_NEAR(record.measures.window.begin, 1.0, 0.02);
    EXPECT_NEAR(displacement_at(record, 2.0).z(), -0.4, 0.01);
}

/// Down a slope, and up again for a while: 0, 2, 1, 4 m deep.
FallSeries record_with_a_rise() {
    FallSeries record;
    record.down = Vector3d(0.6, 0.0, -0.8);
    const Vector3d aside(0, 1, 0);
    record.times = {0.0, 1.0, 2.0, 3.0};
    record.displacements = {Vector3d::Zero(), 2.0 * record.down + aside, record.down + 2.0 * aside,
                            4.0 * record.down + 5.0 * aside};
    return record;
}

TEST(Passages, AreWhereAFallFirstComesSoDeep) {
    const FallSeries record = record_with_a_rise();
    const std::vector<Passage> passages = passages_of(record, {0.5, 1.5, 2.5});
    ASSERT_EQ(passages.size(), 3u);
    EXPECT_DOUBLE_EQ(passages[0].time, 0.25);
    EXPECT_LT((passages[0].place - Vector3d(0, 0.25, 0)).norm(), 1e-15);
    EXPECT_DOUBLE_EQ(passages[1].time, 0.75);
    EXPECT_DOUBLE_EQ(passages[2].time, 2.5);
    EXPECT_LT((passages[2].place - Vector3d(0, 3.5, 0)).norm(), 1e-14);
}

TEST(Passages, AreNoneOfLevelsThatAFallDoesNotReach) {
    const FallSeries record = record_with_a_rise();
    EXPECT_EQ(passages_of(record, {1.0, 4.0, 4.1}).size(), 2u);
    EXPECT_TRUE(passages_of(record, {}).empty());
}

}  // namespace

}  // namespace samara
