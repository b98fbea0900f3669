#include "samara/analysis/metrics/ensemble.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "runtime/synthetic_motion.hpp"

namespace samara {
namespace {

/// `runs` flights of 2 s, whose poses are functions of the run and the time.
template <typename Function>
Motion ensemble_of(int runs, const Function& pose) {
    Motion motion = test::motion_of([&](double time) { return pose(0, time); }, 2.0);
    motion.runs = runs;
    BodyMotion& body = motion.bodies[0];
    for (int run = 1; run < runs; ++run) {
        for (const double time : motion.times) body.poses.push_back(pose(run, time));
    }
    return motion;
}

TEST(WilsonInterval, HoldsTheKnownValues) {
    // Newcombe, Two-sided confidence intervals for the single proportion, Statistics in Medicine 17, 1998,
    // table I, method 3.
    EXPECT_NEAR(wilson_interval(81, 263)[0], 0.2553, 5e-5);
    EXPECT_NEAR(wilson_interval(81, 263)[1], 0.3662, 5e-5);
    EXPECT_NEAR(wilson_interval(15, 148)[0], 0.0624, 5e-5);
    EXPECT_NEAR(wilson_interval(15, 148)[1], 0.1605, 5e-5);
    EXPECT_NEAR(wilson_interval(0, 20)[0], 0.0, 1e-12);
    EXPECT_NEAR(wilson_interval(0, 20)[1], 0.1611, 5e-5);
    EXPECT_NEAR(wilson_interval(1, 29)[0], 0.0061, 5e-5);
    EXPECT_NEAR(wilson_interval(1, 29)[1], 0.1718, 5e-5);
}

TEST(Ensemble, GivesMeanDescentWithItsStandardError) {
    const double speeds[] = {0.2, 0.3, 0.25, 0.21};
    const Motion motion =
        ensemble_of(4, [&](int run, double time) { return test::tumble(time, 1.0, speeds[run]); });
    const BodyMeasures all = measure_all(motion, motion.bodies[0]);
    const double deviation = std::sqrt((0.04 * 0.04 + 0.06 * 0.06 + 0.01 * 0.01 + 0.03 * 0.03) / 3.0);
    EXPECT_EQ(all.samples, 4);
    const Estimate& descent = *all.metrics[Metric::descent_speed];
    EXPECT_NEAR(descent.value, 0.24, 1e-9);
    EXPECT_NEAR(*descent.deviation, deviation, 1e-9);
    EXPECT_NEAR(*descent.error, deviation / 2.0, 1e-9);
}

TEST(Ensemble, CountsRegimesAndGivesTheCommonestWithItsConfidence) {
    const Motion motion = ensemble_of(10, [](int run, double time) {
        return run < 7 ? test::flutter(time, 2.0, 0.5, 0.2) : test::tumble(time, 12.0, 0.2);
    });
    const BodyMeasures all = measure_all(motion, motion.bodies[0]);
    EXPECT_EQ(all.regimes.counts, (std::array<int, 5>{0, 7, 3, 0, 0}));
    EXPECT_EQ(all.regimes.commonest(), Regime::fluttering);
    EXPECT_EQ(all.regimes.share(Regime::fluttering), 0.7);
    EXPECT_EQ(all.regimes.confidence(), wilson_interval(7, 10));
}

TEST(Ensemble, PathsThatPartStraightSpreadLikeTimeAndRandomWalksLikeItsRoot) {
    const Motion straight = ensemble_of(2, [](int run, double time) {
        Pose pose = test::tumble(time, 0.1, 0.2);
        pose.position.x() = (run == 0 ? 0.1 : -0.1) * time;
        return pose;
    });
    const BodyMeasures lines = measure_all(straight, straight.bodies[0]);
    EXPECT_NEAR(lines.path_spread, 0.2, 1e-9);
    ASSERT_TRUE(lines.path_spread_growth.has_value());
    EXPECT_NEAR(*lines.path_spread_growth, 1.0, 1e-9);

    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    std::vector<Vector3d> places(2000, Vector3d::Zero());
    const Motion walks = ensemble_of(2000, [&](int run, double time) {
        Vector3d& place = places[static_cast<std::size_t>(run)];
        Pose pose = test::tumble(time, 0.1, 0.2);
        pose.position.head<2>() = place.head<2>();
        place += 0.01 * Vector3d(normal(random), normal(random), 0.0);
        return pose;
    });
    const BodyMeasures walked = measure_all(walks, walks.bodies[0]);
    EXPECT_NEAR(walked.path_spread, 0.01 * std::sqrt(2.0 * 120.0), 0.01);
    EXPECT_NEAR(*walked.path_spread_growth, 0.5, 0.05);
}

TEST(Ensemble, StartsThatLieApartAreNoSpread) {
    const Motion motion = ensemble_of(5, [](int run, double time) {
        Pose pose = test::tumble(time, 1.0, 0.2);
        pose.position.y() += run;
        return pose;
    });
    const BodyMeasures all = measure_all(motion, motion.bodies[0]);
    EXPECT_EQ(all.path_spread, 0.0);
    EXPECT_FALSE(all.path_spread_growth.has_value());
}

/// Falls flat at 0.2 m/s onto the ground at -0.1 m, the ellipsoid's short half-axis being 1 cm, and lies.
Pose drop(double time, double x) {
    Pose pose;
    const bool falling = 0.2 * time < 0.09;
    pose.position = Vector3d(x, 0.0, falling ? -0.2 * time : -0.09);
    if (falling) pose.velocity.z() = -0.2;
    return pose;
}

TEST(Ensemble, LandingIsWhereABodyFirstTouchesTheGround) {
    Motion motion = ensemble_of(3, [](int run, double time) { return drop(time, 0.1 * run); });
    EXPECT_EQ(measure_all(motion, motion.bodies[0]).landing.count, 0);  // without a ground
    motion.ground = -0.1;
    BodyMotion& body = motion.bodies[0];
    body.contact_points = contact_points(body.surface, body.center_of_mass);
    EXPECT_EQ(landing_frame(motion, body, 0, 0), 27);  // 0.45 s
    EXPECT_NEAR(fall_of(motion, body, 0, 0).end, 27.0 / 60.0, 1e-12);
    const BodyMeasures all = measure_all(motion, body);
    EXPECT_EQ(all.landing.count, 3);
    EXPECT_EQ(all.landing.at_rest, 3);
    EXPECT_NEAR(all.landing.mean.x(), 0.1, 1e-12);
    EXPECT_NEAR(all.landing.spread, 0.1 * std::sqrt(2.0 / 3.0), 1e-9);
    EXPECT_NEAR(all.value(Metric::descent_speed), 0.2, 1e-9);  // the time on the ground does not count
}

TEST(Ensemble, ABounceBetweenTwoFramesIsALanding) {
    constexpr double touch = 0.46;  // s, between the frames 27 and 28
    Motion motion = ensemble_of(1, [](int /*run*/, double time) {
        Pose pose;
        pose.velocity.z() = time < touch ? -0.2 : 0.1;
        pose.position.z() = -0.2 * touch + pose.velocity.z() * (time - touch);
        return pose;
    });
    motion.ground = -0.2 * touch - 0.01;
    BodyMotion& body = motion.bodies[0];
    body.contact_points = contact_points(body.surface, body.center_of_mass);
    EXPECT_EQ(landing_frame(motion, body, 0, 0), 28);
    EXPECT_NEAR(fall_of(motion, body, 0, 0).end, 27.0 / 60.0, 1e-12);
    EXPECT_NEAR(measure_all(motion, body).value(Metric::descent_speed), 0.2, 1e-9);
    motion.ground = -0.2 * touch - 0.012;  // it turns back above the ground
    EXPECT_FALSE(landing_frame(motion, body, 0, 0).has_value());
}

TEST(Ensemble, InPartsIsTheSameAsAtOnce) {
    const Motion motion = ensemble_of(
        6, [](int run, double time) { return test::flutter(time, 2.0, 0.4 + 0.05 * run, 0.2 + 0.01 * run); });
    Motion part = motion;
    Ensemble ensemble;
    const auto frames = motion.times.size();
    part.runs = 2;
    for (std::size_t first = 0; first < 6; first += 2) {
        const auto begin = motion.bodies[0].poses.begin() + static_cast<std::ptrdiff_t>(first * frames);
        part.bodies[0].poses.assign(begin, begin + static_cast<std::ptrdiff_t>(2 * frames));
        ensemble.add(part, part.bodies[0], 2);
    }
    const BodyMeasures parts = ensemble.measures();
    const BodyMeasures whole = measure_all(motion, motion.bodies[0]);
    for (const Metric metric : {Metric::descent_speed, Metric::frequency}) {
        EXPECT_EQ(parts.value(metric), whole.value(metric));
    }
    EXPECT_EQ(parts.path_spread, whole.path_spread);
    EXPECT_EQ(parts.regimes, whole.regimes);
}

}  // namespace
}  // namespace samara
