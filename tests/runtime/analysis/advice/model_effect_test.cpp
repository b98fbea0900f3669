#include "samara/analysis/advice/model_effect.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace samara {
namespace {

constexpr EffectScale scale = {.tolerance = 0.05, .half_length = 0.04};

/// Fluttering falls whose metrics scatter by a part of themselves.
std::vector<SampledFall> falls(std::size_t count, double scatter, unsigned seed = 1) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> normal;
    std::vector<SampledFall> result(count);
    for (SampledFall& fall : result) {
        fall.measured = true;
        constexpr double values[] = {0.2, 0.7, 1.1, 5.0, 0.3};
        for (std::size_t i = 0; i < advised_metrics.size(); ++i) {
            fall.metrics[advised_metrics[i]] = values[i] * (1.0 + scatter * normal(generator));
        }
        fall.regime = Regime::fluttering;
        fall.speed = 0.2;
        fall.distance = 1.0;
    }
    return result;
}

std::vector<SampledFall> with(std::vector<SampledFall> some, Metric metric, double factor) {
    for (SampledFall& fall : some) *fall.metrics[metric] *= factor;
    return some;
}

TEST(ModelEffect, OfTheSameFallsIsNoneAndCertain) {
    const auto some = falls(32, 0.2);
    const FallsEffect effect = effect_of(some, some, scale);
    EXPECT_EQ(effect.verdict, EffectVerdict::within);
    EXPECT_EQ(effect.falls, 32U);
    for (const Metric metric : advised_metrics) {
        EXPECT_EQ(effect.metrics[metric].change->value, 0.0);
        EXPECT_EQ(effect.metrics[metric].change->error, 0.0);
    }
}

TEST(ModelEffect, IsToldFromChanceByPairs) {
    // The falls scatter by 20 %, and every pair shares it: a change of 4 % is seen, and is within 5 %.
    const auto before = falls(32, 0.2);
    const FallsEffect effect = effect_of(before, with(before, Metric::descent_speed, 1.04), scale);
    EXPECT_EQ(effect.verdict, EffectVerdict::within);
    const Estimate& change = *effect.metrics[Metric::descent_speed].change;
    EXPECT_NEAR(change.value / effect.metrics[Metric::descent_speed].reference->value, 0.04, 1e-12);
    EXPECT_NEAR(*change.error, 0.04 * 0.2 * 0.2 / std::sqrt(32.0), 0.3 * 0.04 * 0.2 * 0.2 / std::sqrt(32.0));
    EXPECT_EQ(effect_of(before, with(before, Metric::descent_speed, 1.06), scale).verdict,
              EffectVerdict::beyond);
}

TEST(ModelEffect, OfFallsThatScatterTooMuchIsNotCertain) {
    EXPECT_EQ(effect_of(falls(32, 0.2, 1), falls(32, 0.2, 2), scale).verdict, EffectVerdict::not_certain);
    EXPECT_EQ(effect_of(falls(32, 0.01, 1), falls(32, 0.01, 2), scale).verdict, EffectVerdict::within);
    const auto few = falls(4, 0.0);
    EXPECT_EQ(effect_of(few, few, scale).verdict, EffectVerdict::not_certain);
}

TEST(ModelEffect, ItsErrorIsThatOfIndependentFalls) {
    const FallsEffect effect = effect_of(falls(2000, 0.1, 1), falls(2000, 0.1, 2), scale);
    const double expected = 0.2 * 0.1 * std::sqrt(2.0 / 2000.0);
    EXPECT_NEAR(*effect.metrics[Metric::descent_speed].change->error, expected, 0.1 * expected);
    EXPECT_LT(std::abs(effect.metrics[Metric::descent_speed].change->value), 4.0 * expected);
}

TEST(ModelEffect, IsJudgedInTheProportionsOfTheMetrics) {
    const auto before = falls(16, 0.0);
    const double allowed[] = {0.05, 0.15, 0.10, 0.15, 0.15};  // of a tolerance of 5 %
    for (std::size_t i = 0; i < 5; ++i) {
        const Metric metric = advised_metrics[i];
        EXPECT_EQ(effect_of(before, with(before, metric, 1.0 + 0.99 * allowed[i]), scale).verdict,
                  EffectVerdict::within)
            << catalogued(metric).key;
        // The path may also change by 5 % of the path's 1 m: a sixth of its spread.
        const double beyond = metric == Metric::path_spread ? 0.17 : 1.01 * allowed[i];
        EXPECT_EQ(effect_of(before, with(before, metric, 1.0 + beyond), scale).verdict, EffectVerdict::beyond)
            << catalogued(metric).key;
    }
}

TEST(ModelEffect, OfSmallMetricsIsJudgedByTheWay) {
    auto before = falls(16, 0.0);
    for (SampledFall& fall : before) {
        fall.metrics[Metric::inclination_amplitude] = 0.001;
        fall.metrics[Metric::frequency].reset();
        fall.metrics[Metric::rms_angular_speed] = 0.01;
        fall.metrics[Metric::path_spread] = 1e-4;
    }
    auto after = before;
    for (SampledFall& fall : after) {
        fall.metrics[Metric::inclination_amplitude] = 0.001 + 0.9 * std::numbers::pi / 180.0;
        fall.metrics[Metric::rms_angular_speed] = 0.01 + 0.9 * 0.05 * 0.2 / 0.04;
        fall.metrics[Metric::path_spread] = 1e-4 + 0.9 * 0.05;
    }
    EXPECT_EQ(effect_of(before, after, scale).verdict, EffectVerdict::within);
    for (SampledFall& fall : after) fall.metrics[Metric::path_spread] = 1e-4 + 1.1 * 0.05;
    EXPECT_EQ(effect_of(before, after, scale).verdict, EffectVerdict::beyond);
}

TEST(ModelEffect, OfAFrequencyThatComesOrGoesIsBeyond) {
    const auto before = falls(16, 0.0);
    auto after = before;
    for (std::size_t i = 0; i < 9; ++i) after[i].metrics[Metric::frequency].reset();
    EXPECT_EQ(effect_of(before, after, scale).verdict, EffectVerdict::beyond);
    EXPECT_EQ(effect_of(after, after, scale).verdict, EffectVerdict::within);
}

TEST(ModelEffect, OfRegimesIsBeyondWhereChanceDoesNotExplainIt) {
    const auto before = falls(32, 0.0);
    auto after = before;
    for (std::size_t i = 0; i < 17; ++i) after[i].regime = Regime::tumbling;
    const FallsEffect effect = effect_of(before, after, scale);
    EXPECT_EQ(effect.verdict, EffectVerdict::beyond);
    EXPECT_FALSE(effect.regimes_agree);
    auto half = before;
    for (std::size_t i = 0; i < 15; ++i) half[i].regime = Regime::tumbling;
    EXPECT_TRUE(effect_of(half, after, scale).regimes_agree);
    EffectScale of_a_ball = scale;
    of_a_ball.judges_inclination = false;
    EXPECT_EQ(effect_of(before, after, of_a_ball).verdict, EffectVerdict::within);
}

TEST(ModelEffect, LeavesFallsOutThatAreTooShort) {
    const auto before = falls(32, 0.0);
    auto after = with(before, Metric::descent_speed, 1.5);
    for (std::size_t i = 8; i < 32; ++i) after[i].measured = false;
    EXPECT_EQ(effect_of(before, after, scale).falls, 8U);
    for (SampledFall& fall : after) fall.measured = false;
    EXPECT_EQ(effect_of(before, after, scale).verdict, EffectVerdict::not_certain);
}

}  // namespace
}  // namespace samara
