#include "samara/analysis/comparison/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "irregular_flutter.hpp"
#include "samara/analysis/comparison/comparison_report.hpp"
#include "samara/motion/inclination.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::degree;
using test::error_of;
using test::TemporaryFolder;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

Motion flutter(double frequency, double amplitude, double speed, double duration = 6.0,
               double frame_rate = 60.0) {
    return test::motion_of([=](double t) { return test::flutter(t, frequency, amplitude, speed); }, duration,
                           frame_rate);
}

ComparisonSettings narrow() {
    ComparisonSettings settings;
    settings.tolerances[Metric::descent_speed] = 0.05;
    settings.tolerances[Metric::frequency] = 0.05;
    return settings;
}

/// Irregular flutters as runs of one motion.
Motion runs_of(unsigned first_seed, int runs, double duration) {
    Motion motion = test::irregular_flutter(first_seed, duration);
    for (int run = 1; run < runs; ++run) {
        const Motion more = test::irregular_flutter(first_seed + static_cast<unsigned>(run), duration);
        motion.bodies[0].poses.insert(motion.bodies[0].poses.end(), more.bodies[0].poses.begin(),
                                      more.bodies[0].poses.end());
    }
    motion.runs = runs;
    return motion;
}

Comparison compare_motions(const Motion& motion, const Motion& reference,
                           const ComparisonSettings& settings = {}) {
    const TemporaryFolder folder;
    write_motion_file(folder / "motion.h5", motion);
    write_motion_file(folder / "reference.h5", reference);
    const MotionReader first(folder / "motion.h5");
    const MotionReader second(folder / "reference.h5");
    return compare({"motion.h5", &first, 0, {}, {}}, {"reference.h5", &second, 0, {}, {}}, settings,
                   [](double, double) {});
}

const MetricComparison& metric(const Comparison& comparison, Metric which) {
    return comparison.metrics.at(static_cast<std::size_t>(which));
}

TEST(Comparison, OfAMotionWithItselfShowsNoDifference) {
    const Motion motion = test::irregular_flutter(5, 8.0);
    const Comparison comparison = compare_motions(motion, motion);
    EXPECT_TRUE(comparison.agrees);
    EXPECT_TRUE(comparison.notes.empty()) << comparison.notes.front();
    for (const CataloguedMetric& entry : metric_catalogue) {
        const MetricComparison& one = comparison.metrics[entry.metric];
        ASSERT_EQ(one.difference.has_value(), !is_of_autorotation(entry.metric)) << entry.title;
        if (!one.difference) continue;
        EXPECT_EQ(*one.difference, 0.0);
        ASSERT_TRUE(one.difference_error.has_value());
        EXPECT_DOUBLE_EQ(*one.difference_error, std::sqrt(2.0) * *one.motion->error);
    }
    for (const MetricComparison& one : comparison.quantiles) EXPECT_EQ(one.difference, 0.0);
    EXPECT_EQ(comparison.distributions.front().distance.distance, 0.0);
    EXPECT_EQ(comparison.distributions.front().distance.chance->probability, 1.0);
    EXPECT_EQ(comparison.first_swing.minimum_time.difference, 0.0);
    EXPECT_EQ(comparison.first_swing.path_distance->value, 0.0);
}

TEST(Comparison, HoldsTheLandingsOfSeveralFallsAgainstEachOther) {
    const Motion three = runs_of(1, 3, 6.0);
    const Comparison all = compare_motions(runs_of(4, 5, 8.0), three);
    ASSERT_EQ(all.landings.size(), 4u);
    EXPECT_DOUBLE_EQ(
        all.landings[3].depth,
        std::min(all.motion_lengths.shallowest, all.reference_lengths.shallowest) * (1.0 - 1e-9));
    EXPECT_DOUBLE_EQ(all.landings[0].depth, 0.25 * all.landings[3].depth);
    EXPECT_LT(all.landings[0].motion.time.value, all.landings[3].motion.time.value);
    EXPECT_THAT(as_text(all), HasSubstr("m below the release"));
    EXPECT_EQ(as_json(all)["landings"].size(), 4u);
    // Two falls do not scatter.
    EXPECT_TRUE(compare_motions(three, runs_of(4, 2, 6.0)).landings.empty());
}

// The window of 4 s holds whole swings of both.
TEST(Comparison, ShowsByHowMuchFluttersOfKnownMetricsDiffer) {
    const Comparison comparison = compare_motions(flutter(1.375, 40.0 * degree, 0.198, 6.0, 240.0),
                                                  flutter(1.25, 32.0 * degree, 0.22, 6.0, 240.0));
    EXPECT_NEAR(metric(comparison, Metric::frequency).relative.value(), 0.1, 2e-3);
    EXPECT_NEAR(metric(comparison, Metric::spectral_frequency).relative.value(), 0.1, 0.01);
    EXPECT_NEAR(metric(comparison, Metric::descent_speed).relative.value(), -0.1, 1e-9);
    EXPECT_NEAR(metric(comparison, Metric::inclination_amplitude).relative.value(), 0.25, 5e-3);
    EXPECT_NEAR(metric(comparison, Metric::rms_angular_speed).relative.value(), 1.1 * 1.25 - 1.0, 1e-3);
    EXPECT_NEAR(comparison.first_swing.maximum_inclination.difference.value(), 8.0 * degree, 0.3 * degree);
    EXPECT_NEAR(comparison.first_swing.minimum_time.difference.value(), 0.25 / 1.375 - 0.25 / 1.25, 0.003);
    EXPECT_EQ(comparison.motion.regimes.commonest(), Regime::fluttering);
}

TEST(Comparison, MeasuresTheLastTwoThirdsOfTheShorterFall) {
    const Comparison comparison = compare_motions(flutter(1.3, 0.6, 0.2, 9.0), flutter(1.3, 0.6, 0.2, 6.0));
    EXPECT_NEAR(comparison.window.begin, 2.0, 1e-9);
    EXPECT_NEAR(comparison.window.end, 6.0, 1e-9);
    EXPECT_THAT(comparison.notes,
                Contains(HasSubstr("the motion's falls last 9 s or more, the reference's 6 s")));
}

TEST(Comparison, RefusesAWindowThatOneOfTheFallsDoesNotCover) {
    const Motion motion = flutter(1.3, 0.6, 0.2, 4.0);
    ComparisonSettings settings;
    settings.window = TimeWindow{1.0, 3.5};
    EXPECT_EQ(compare_motions(motion, motion, settings).window.end, 3.5);
    for (const TimeWindow window : {TimeWindow{1.0, 5.0}, TimeWindow{2.0, 1.0}, TimeWindow{-1.0, 2.0}}) {
        settings.window = window;
        EXPECT_THAT(error_of([&] { compare_motions(motion, motion, settings); }),
                    HasSubstr("is not within both falls: motion.h5 lasts 4 s, reference.h5 lasts 4 s"));
    }
}

TEST(Comparison, ABodyThatWaitsForItsStartFallsLikeOneThatDoesNot) {
    const auto late = [](double t) {
        return t < 1.0 ? test::flutter(0.0, 1.3, 0.6, 0.0) : test::flutter(t - 1.0, 1.3, 0.6, 0.2);
    };
    Motion motion = test::motion_of(late, 7.0);
    for (int i = 0; i < 60; ++i) motion.bodies[0].poses[static_cast<std::size_t>(i)].velocity.setZero();
    for (int i = 0; i < 60; ++i)
        motion.bodies[0].poses[static_cast<std::size_t>(i)].angular_velocity.setZero();
    const Comparison comparison = compare_motions(motion, flutter(1.3, 0.6, 0.2, 6.0));
    EXPECT_TRUE(comparison.agrees);
    EXPECT_NEAR(metric(comparison, Metric::frequency).relative.value(), 0.0, 1e-3);
    // The release is the last frame at rest.
    EXPECT_NEAR(comparison.first_swing.minimum_time.difference.value(), 0.0, 1.0 / 60.0 + 1e-6);
}

TEST(Comparison, SeveralRunsHaveTheErrorOfTheirMeanByTheirScatter) {
    const Comparison comparison = compare_motions(runs_of(10, 12, 8.0), test::irregular_flutter(99, 8.0));
    EXPECT_EQ(comparison.motion.distinct, 12);
    const MetricComparison& descent = metric(comparison, Metric::descent_speed);
    EXPECT_DOUBLE_EQ(*descent.motion->error, *descent.motion->deviation / std::sqrt(12.0));
    // A single fall's error counts as no less than the runs' deviation.
    EXPECT_DOUBLE_EQ(
        *descent.difference_error,
        std::hypot(*descent.motion->error, std::max(*descent.reference->error, *descent.motion->deviation)));
    EXPECT_LT(descent.in_errors.value(), 4.0);
    EXPECT_TRUE(comparison.distributions.front().distance.by_falls);
}

TEST(Comparison, RunsThatRepeatOneAnotherCountOnce) {
    Motion motion = test::irregular_flutter(7, 8.0);
    const std::vector<Pose> poses = motion.bodies[0].poses;
    for (int run = 1; run < 4; ++run) {
        motion.bodies[0].poses.insert(motion.bodies[0].poses.end(), poses.begin(), poses.end());
    }
    motion.runs = 4;
    const Comparison comparison = compare_motions(motion, test::irregular_flutter(8, 8.0));
    EXPECT_EQ(comparison.motion.falls, 4);
    EXPECT_EQ(comparison.motion.distinct, 1);
    EXPECT_GT(metric(comparison, Metric::descent_speed).motion->error.value(), 0.0);
    EXPECT_THAT(comparison.notes, Contains(HasSubstr("the motion has 4 falls, of which 1 is distinct")));
}

TEST(Comparison, OtherRegimesDiffer) {
    const Motion tumbling = test::motion_of([](double t) { return test::tumble(t, 8.0, 0.2); }, 6.0);
    const Comparison comparison = compare_motions(tumbling, flutter(1.3, 0.6, 0.2));
    EXPECT_FALSE(comparison.regimes_agree);
    EXPECT_FALSE(comparison.agrees);
    EXPECT_TRUE(comparison.certain);
    EXPECT_EQ(metric(comparison, Metric::descent_speed).verdict->agrees, true);
}

TEST(Comparison, NamesWhatMakesMetricsDoubtful) {
    const auto sparse = [](double t) { return test::flutter(t + 0.1, 3.1, 0.6, 0.2); };
    Motion other = test::motion_of(sparse, 1.0, 30.0);
    for (Vector3d& vertex : other.bodies[0].surface.vertices) vertex *= 1.2;
    const Comparison comparison = compare_motions(flutter(1.3, 0.6, 0.2, 1.0), other);
    EXPECT_THAT(comparison.notes, Contains(HasSubstr("the bodies differ")));
    EXPECT_THAT(comparison.notes, Contains(HasSubstr("degrees apart at the release")));
    EXPECT_THAT(comparison.notes, Contains(HasSubstr("the reference has 4.8 frames for each swing")));
    EXPECT_THAT(comparison.notes, Contains(HasSubstr("the motion's window has too few swings")));
}

TEST(Comparison, RefusesOtherGravityAndFramesTooFarApartAndSingleFrames) {
    const Motion motion = flutter(1.3, 0.6, 0.2, 4.0);
    Motion on_the_moon = motion;
    on_the_moon.gravity = Vector3d(0.0, 0.0, -1.62);
    EXPECT_THAT(error_of([&] { compare_motions(motion, on_the_moon); }),
                HasSubstr("reference.h5 has [0, 0, -1.62]: they cannot be compared"));
    const Motion fast = test::motion_of([](double t) { return test::tumble(t, 40.0, 0.2); }, 4.0, 24.0);
    EXPECT_THAT(error_of([&] { compare_motions(fast, motion); }),
                HasSubstr("motion.h5: 'ellipsoid' rotates by up to 95 degrees between frames"));
    const Motion single = test::motion_of([](double) { return Pose{}; }, 0.0);
    EXPECT_THAT(error_of([&] { compare_motions(motion, single); }), HasSubstr("has a single frame"));
}

TEST(Comparison, IsCertainOnlyWhereTheErrorsAllowIt) {
    const Motion motion = flutter(1.3, 0.6, 0.2);
    EXPECT_TRUE(compare_motions(motion, motion).certain);
    EXPECT_FALSE(compare_motions(flutter(1.3, 0.6, 0.2, 1.0), flutter(1.3, 0.6, 0.2, 1.0)).certain);
    const Comparison faster = compare_motions(flutter(1.3, 0.6, 0.3), motion);
    EXPECT_TRUE(!faster.agrees && faster.certain);
}

TEST(Comparison, OfASphereOrACubeJudgesTheDescentSpeedAlone) {
    for (const Surface& surface : {test::ellipsoid({0.02, 0.02, 0.02}, 2), test::box({2.0, 2.0, 2.0}, 1)}) {
        Motion motion = test::motion_of([](double t) { return test::tumble(t, 3.0, 0.2); }, 6.0);
        Motion reference = test::motion_of([](double t) { return test::tumble(t, 0.01, 0.21); }, 6.0);
        motion.bodies[0].surface = surface;
        reference.bodies[0].surface = surface;
        const Comparison comparison = compare_motions(motion, reference);
        EXPECT_FALSE(comparison.judges_inclination);
        EXPECT_TRUE(comparison.agrees);
        EXPECT_FALSE(comparison.regimes_agree);
        EXPECT_FALSE(metric(comparison, Metric::inclination_amplitude).verdict.has_value());
        EXPECT_TRUE(metric(comparison, Metric::descent_speed).verdict->agrees);
        EXPECT_THAT(comparison.notes, Contains(HasSubstr("only the descent speed is judged")));
    }
}

TEST(Inclination, OfAnEllipsoidWithAxesThatDifferByAFewPerCentHasAShortestAxis) {
    BodyMotion body;
    body.surface = test::ellipsoid({0.0103, 0.01, 0.0102}, 3);
    for (Vector3d& vertex : body.surface.vertices) vertex += Vector3d(0.3, -0.2, 0.1);
    EXPECT_TRUE(has_shortest_axis(body.surface));
    body.surface = test::ellipsoid({0.01, 0.01, 0.01}, 1);
    EXPECT_FALSE(has_shortest_axis(body.surface));
}

TEST(MetricComparison, AgreesWithinTheToleranceAndIsCertainTwoErrorsFromIt) {
    const Estimate reference{2.0, 0.03, {}};
    const auto verdict = [&](double value, double error) {
        return compare_metric(Estimate{value, error, {}}, reference, 0.1).verdict.value();
    };
    EXPECT_DOUBLE_EQ(verdict(2.0, 0.04).limit, 0.2);
    EXPECT_TRUE(verdict(2.09, 0.04).agrees && verdict(2.09, 0.04).certain);
    EXPECT_TRUE(verdict(2.15, 0.04).agrees && !verdict(2.15, 0.04).certain);
    EXPECT_TRUE(!verdict(2.25, 0.04).agrees && !verdict(2.25, 0.04).certain);
    EXPECT_TRUE(!verdict(1.65, 0.04).agrees && verdict(1.65, 0.04).certain);
    EXPECT_NEAR(*compare_metric(Estimate{2.1, 0.04, {}}, reference, 0.1).in_errors, 2.0, 1e-12);
    EXPECT_FALSE(compare_metric(Estimate{2.0, {}, {}}, reference, 0.1).verdict->certain);
}

TEST(MetricComparison, CountsWhatLiesBeyondTheReferencesOwnUncertainty) {
    const Estimate reference{2.0, 0.0, {}};
    const auto verdict = [&](double value) {
        return compare_metric(Estimate{value, 0.01, {}}, reference, 0.1, 0.0, 0.05).verdict.value();
    };
    EXPECT_TRUE(verdict(2.05).agrees && verdict(2.05).certain);
    EXPECT_TRUE(verdict(2.15).agrees && !verdict(2.15).certain) << "the reference's may be 1.9";
    EXPECT_TRUE(verdict(2.29).agrees && !verdict(2.29).certain) << "the reference's may be 2.1";
    EXPECT_TRUE(!verdict(2.31).agrees && !verdict(2.31).certain);
    EXPECT_TRUE(!verdict(1.65).agrees && verdict(1.65).certain);
    EXPECT_DOUBLE_EQ(compare_metric(Estimate{2.0, {}, {}}, reference, 0.1, 0.0, 0.05).reference_uncertainty,
                     0.1);
}

TEST(MetricComparison, OfAReferenceThatMayHaveAFrequencyOrNoneIsUndecided) {
    for (const bool motion_has_it : {true, false}) {
        const auto one = motion_has_it ? std::optional(Estimate{1.0, {}, {}}) : std::nullopt;
        const auto other = motion_has_it ? std::nullopt : std::optional(Estimate{1.0, {}, {}});
        const auto verdict = compare_metric(one, other, 0.2, 0.0, 1.0).verdict.value();
        EXPECT_TRUE(verdict.agrees && !verdict.certain);
    }
}

TEST(Comparison, SaysWhatTheReferenceIsUncertainBy) {
    const Motion motion = flutter(1.375, 40.0 * degree, 0.198, 6.0, 240.0);
    Motion reference = flutter(1.25, 40.0 * degree, 0.18, 6.0, 240.0);
    const std::string without = as_text(compare_motions(motion, reference, narrow()));
    EXPECT_THAT(without, HasSubstr("differs"));
    EXPECT_THAT(without, Not(HasSubstr("reference's own")));
    reference.bodies[0].uncertainties = {
        {"closure", "descent_speed", 0.04}, {"mesh", "descent_speed", 0.03}, {"mesh", "frequency", 0.06}};
    const Comparison comparison = compare_motions(motion, reference, narrow());
    EXPECT_TRUE(comparison.agrees);
    EXPECT_FALSE(comparison.certain);
    EXPECT_NEAR(metric(comparison, Metric::descent_speed).reference_uncertainty, 0.07 * 0.18, 1e-4);
    EXPECT_THAT(as_text(comparison), HasSubstr("agrees? (limit 5 % beyond the reference's own 7 %)"));
}

TEST(Comparison, LeavesTheRegimeOpenThatTheReferenceItselfIsUncertainOf) {
    const Motion motion = test::motion_of([](double t) { return test::tumble(t, 5.0, 0.2); }, 6.0, 240.0);
    Motion reference = flutter(1.25, 40.0 * degree, 0.2, 6.0, 240.0);
    ComparisonSettings wide;
    for (const Metric one : compared_metrics) wide.tolerances[one] = 10.0;
    EXPECT_FALSE(compare_motions(motion, reference, wide).agrees);
    reference.bodies[0].uncertainties = {{"mesh", "regime", 1.0}};
    const Comparison comparison = compare_motions(motion, reference, wide);
    EXPECT_TRUE(comparison.regime_is_uncertain);
    EXPECT_TRUE(comparison.agrees_by_metrics);
    // It flutters where the motion turns over, but on another mesh it may not.
    EXPECT_TRUE(!comparison.agrees && !comparison.certain);
    EXPECT_THAT(comparison.irregular_because, HasSubstr("depends on its mesh"));
    EXPECT_THAT(as_text(comparison), HasSubstr("the reference itself is uncertain"));
}

/// A fall that flutters and now and then turns over, in an order drawn from the seed.
Motion chaotic_fall(unsigned seed, double tumbling_share, double descent = 0.2) {
    std::mt19937 generator(seed);
    std::vector<double> angles = {0.0};
    constexpr double swing = 0.4;
    for (int i = 0; i < 40; ++i) {
        const bool turns_over = static_cast<double>(generator() % 1000) < 1000.0 * tumbling_share;
        const double side = generator() % 2 == 0 ? 1.0 : -1.0;
        angles.push_back(angles.back() + (turns_over ? side * std::numbers::pi : 0.0));
    }
    return test::motion_of(
        [=](double t) {
            const auto i = std::min(static_cast<std::size_t>(t / swing), angles.size() - 2);
            const double phase = t / swing - static_cast<double>(i);
            const double change = angles[i + 1] - angles[i];
            const double smooth = 0.5 - 0.5 * std::cos(std::numbers::pi * phase);
            const double side = i % 2 == 0 ? 1.0 : -1.0;
            const double angle = change != 0.0 ? angles[i] + change * smooth
                                               : angles[i] + side * 0.7 * std::sin(std::numbers::pi * phase);
            Pose pose;
            pose.position = Vector3d(0.0, 0.0, -descent * t);
            pose.velocity = Vector3d(0.0, 0.0, -descent);
            pose.orientation = Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitX()));
            pose.angular_velocity =
                Vector3d(change != 0.0 ? 0.5 * change * std::numbers::pi / swing : 5.0, 0.0, 0.0);
            return pose;
        },
        16.0, 120.0);
}

TEST(Comparison, OfChaoticFallsRestsOnDescentDriftAndDistributions) {
    const Motion reference = chaotic_fall(1, 0.4);
    const Comparison alike = compare_motions(chaotic_fall(2, 0.4), reference, {});
    EXPECT_THAT(alike.irregular_because, HasSubstr("chaotic"));
    EXPECT_TRUE(alike.agrees) << as_text(alike);
    EXPECT_THAT(as_text(alike),
                HasSubstr("judged by descent, drift and distributions, since the reference is chaotic"));
    for (const DistributionComparison& one : alike.distributions)
        EXPECT_TRUE(one.verdict && one.verdict->agrees);
    // One that hardly turns over has another distribution of its modes, and a fast one another descent.
    const Comparison gentle = compare_motions(chaotic_fall(3, 0.05), reference, {});
    EXPECT_FALSE(gentle.agrees);
    EXPECT_FALSE(gentle.distributions[static_cast<std::size_t>(Distribution::mode)].verdict->agrees);
    EXPECT_FALSE(compare_motions(chaotic_fall(2, 0.4, 0.3), reference, {}).agrees);
}

TEST(Comparison, OfRegularFallsRestsOnTheMetrics) {
    const Motion motion = flutter(1.25, 40.0 * degree, 0.18, 6.0, 240.0);
    const Comparison comparison = compare_motions(motion, motion, {});
    EXPECT_EQ(comparison.irregular_because, "");
    for (const DistributionComparison& one : comparison.distributions) EXPECT_FALSE(one.verdict);
    EXPECT_TRUE(comparison.agrees && comparison.agrees_by_metrics);
}

TEST(MetricComparison, WithoutAFrequencyOnBothSidesIsNotJudgedAndOnOneSideDiffers) {
    EXPECT_FALSE(compare_metric({}, {}, 0.2).verdict.has_value());
    EXPECT_FALSE(compare_metric(Estimate{1.0, {}, {}}, {}, 0.2).verdict->agrees);
    EXPECT_FALSE(compare_metric({}, Estimate{1.0, {}, {}}, 0.2).verdict->agrees);
    EXPECT_FALSE(compare_metric({}, Estimate{1.0, {}, {}}).verdict.has_value());
}

TEST(MetricComparison, SmallMetricsMayDifferByTheLeastLimit) {
    EXPECT_TRUE(compare_metric(Estimate{0.9, {}, {}}, Estimate{0.0, {}, {}}, 0.3, 1.0).verdict->agrees);
    EXPECT_FALSE(compare_metric(Estimate{1.1, {}, {}}, Estimate{0.0, {}, {}}, 0.3, 1.0).verdict->agrees);
}

TEST(DistributionDistance, ByChanceIsExceededAsOftenAsItsProbabilitySays) {
    // Falls of one kind: probabilities are even between 0 and 1.
    int below_a_fifth = 0;
    constexpr unsigned pairs = 40;
    for (unsigned pair = 0; pair < pairs; ++pair) {
        PieceHistograms sides[2];
        for (unsigned side = 0; side < 2; ++side) {
            const Motion motion = test::irregular_flutter(1000 + 2 * pair + side, 8.0);
            const FallSeries record = fall_series(motion, motion.bodies[0], 0, 0, {1.0, 8.0});
            sides[side] = {fall_metrics(record, 7.0).histograms.front()};
        }
        const DistributionDistance distance = distribution_distance(sides[0], sides[1]);
        below_a_fifth += distance.chance->probability < 0.2 ? 1 : 0;
        EXPECT_LT(distance.chance->mean, distance.chance->limit);
    }
    // 8 expected; 16 or more of 40 have a probability of 0.3 %.
    EXPECT_LT(below_a_fifth, 16);
    EXPECT_GT(below_a_fifth, 1);
}

TEST(DistributionDistance, OfSeparateDistributionsIsOneAndNotByChance) {
    Histogram low{};
    Histogram high{};
    low[10] = 2.0;
    high[40] = 0.5;
    const DistributionDistance distance =
        distribution_distance({{low, low, low, low}}, {{high, high, high, high}});
    EXPECT_DOUBLE_EQ(distance.distance, 1.0);
    EXPECT_LT(distance.chance->probability, 0.06);  // 2 of the 70 ways to draw four of eight are as far apart
    EXPECT_FALSE(distribution_distance({{low, low}}, {{high, high}}).chance.has_value());
}

TEST(ComparisonReport, WritesMetricsToTheDigitsThatTheirErrorsAllow) {
    EXPECT_EQ(with_error({0.183217, 0.00123, {}}), "0.1832 +- 0.0012");
    EXPECT_EQ(with_error({183.217, 12.3, {}}), "183 +- 12");
    EXPECT_EQ(with_error({0.5, 0.1, {}}, 180.0 / std::numbers::pi), "28.6 +- 5.7");
    EXPECT_EQ(with_error({0.183217, {}, {}}), "0.1832");
    EXPECT_EQ(with_error({0.25, 0.0, {}}), "0.25 +- 0");
}

}  // namespace
}  // namespace samara
