#include "samara/analysis/comparison/distribution_distance.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace samara {
namespace {

using Falls = PieceHistograms;

/// A piece that spends its time (s) in the interval numbered `bin`.
Histogram time_in(std::size_t bin, double seconds = 1.0) {
    Histogram histogram{};
    histogram[bin] = seconds;
    return histogram;
}

/// One fall whose pieces each spend a second about an interval drawn evenly from `low` to `high`.
std::vector<Histogram> drawn_pieces(std::mt19937& generator, int pieces, int low, int high) {
    std::vector<Histogram> fall;
    for (int i = 0; i < pieces; ++i) {
        const auto size = static_cast<unsigned>(high - low);
        fall.push_back(time_in(static_cast<std::size_t>(low) + generator() % size));
    }
    return fall;
}

TEST(DistributionDistance, IsTheLargestDifferenceOfTheDistributionFunctions) {
    // Below interval 11: 3/4 of the one, 1/4 of the other; nowhere is the difference larger.
    const Falls one = {{time_in(5, 2.0), time_in(10, 1.0), time_in(20, 1.0)}};
    const Falls other = {{time_in(10, 1.0), time_in(20, 1.0), time_in(30, 2.0)}};
    EXPECT_DOUBLE_EQ(distribution_distance(one, other).distance, 0.5);
    // Time counts, not pieces: the same shares in other pieces.
    const Falls in_pieces = {{time_in(5, 0.5), time_in(5, 1.5), time_in(10, 1.0)}, {time_in(20, 1.0)}};
    EXPECT_DOUBLE_EQ(distribution_distance(in_pieces, other).distance, 0.5);
    const Falls slower = {{time_in(5, 20.0), time_in(10, 10.0), time_in(20, 10.0)}};
    EXPECT_DOUBLE_EQ(distribution_distance(slower, other).distance, 0.5);
}

TEST(DistributionDistance, IsZeroOfEqualSharesAndOneOfSharesThatNowhereMeet) {
    const Falls low = {{time_in(1), time_in(2), time_in(3)}};
    const Falls high = {{time_in(80), time_in(81), time_in(89)}};
    EXPECT_EQ(distribution_distance(low, low).distance, 0.0);
    EXPECT_EQ(distribution_distance(low, low).chance->probability, 1.0);
    EXPECT_DOUBLE_EQ(distribution_distance(low, high).distance, 1.0);
}

TEST(DistributionDistance, IsSymmetric) {
    std::mt19937 generator(4);
    const Falls one = {drawn_pieces(generator, 12, 0, 60)};
    const Falls other = {drawn_pieces(generator, 20, 20, 90)};
    const DistributionDistance there = distribution_distance(one, other);
    const DistributionDistance back = distribution_distance(other, one);
    EXPECT_DOUBLE_EQ(there.distance, back.distance);
    // Chance is drawn from the same pieces in another order.
    EXPECT_NEAR(there.chance->mean, back.chance->mean, 0.02);
    EXPECT_NEAR(there.chance->limit, back.chance->limit, 0.05);
}

TEST(DistributionDistance, IsTheSameEveryTime) {
    std::mt19937 generator(5);
    const Falls one = {drawn_pieces(generator, 8, 0, 60)};
    const Falls other = {drawn_pieces(generator, 9, 0, 70)};
    const DistributionDistance first = distribution_distance(one, other);
    const DistributionDistance second = distribution_distance(one, other);
    EXPECT_EQ(first.chance->mean, second.chance->mean);
    EXPECT_EQ(first.chance->limit, second.chance->limit);
    EXPECT_EQ(first.chance->probability, second.chance->probability);
}

TEST(DistributionDistance, OfThreePiecesAgainstThreeChanceIsKnownExactly) {
    // Of the 20 ways to draw three of six, two give the largest distance, 1.
    const Falls low = {{time_in(1), time_in(2), time_in(3)}};
    const Falls high = {{time_in(4), time_in(5), time_in(6)}};
    const DistributionDistance result = distribution_distance(low, high);
    EXPECT_DOUBLE_EQ(result.distance, 1.0);
    EXPECT_NEAR(result.chance->probability, 2.0 / 20.0, 0.03);  // three standard deviations of 999 draws
    // 1 twice, 2/3 in 10 of the 20 ways, 1/3 in 8.
    EXPECT_NEAR(result.chance->mean, (2.0 + 10.0 * 2.0 / 3.0 + 8.0 / 3.0) / 20.0, 0.02);
}

TEST(DistributionDistance, CallsFallsOfOneKindApartAsSeldomAsItSays) {
    std::mt19937 generator(6);
    constexpr int trials = 400;
    int beyond = 0;
    int improbable = 0;
    for (int trial = 0; trial < trials; ++trial) {
        const Falls one = {drawn_pieces(generator, 12, 0, 90)};
        const Falls other = {drawn_pieces(generator, 12, 0, 90)};
        const DistributionDistance result = distribution_distance(one, other);
        if (result.distance > result.chance->limit) ++beyond;
        if (result.chance->probability < 0.05) ++improbable;
    }
    // Distances are steps of a twelfth, many of them equal: no more than 5 in a hundred, and some.
    EXPECT_LE(beyond, 0.05 * trials + 3.0 * std::sqrt(0.05 * 0.95 * trials));
    EXPECT_LE(improbable, 0.05 * trials + 3.0 * std::sqrt(0.05 * 0.95 * trials));
    EXPECT_GT(beyond, 0);
    EXPECT_GT(improbable, 0);
}

TEST(DistributionDistance, FindsFallsOfTwoKindsApart) {
    std::mt19937 generator(7);
    int found = 0;
    for (int trial = 0; trial < 50; ++trial) {
        const Falls one = {drawn_pieces(generator, 12, 0, 60)};
        const Falls other = {drawn_pieces(generator, 12, 40, 90)};
        if (distribution_distance(one, other).chance->probability < 0.05) ++found;
    }
    EXPECT_GE(found, 48);
}

TEST(DistributionDistance, OfOneFallAgainstTenChanceIsWhatTheTenAreFromOneAnother) {
    // Nine falls alike and a tenth that is nowhere like them: 1 from the others, which are 1/9 from theirs.
    Falls ten(10, {time_in(10), time_in(10)});
    ten.back() = {time_in(70), time_in(70)};
    const DistributionDistance alike = distribution_distance({{time_in(10)}}, ten);
    EXPECT_TRUE(alike.by_falls);
    EXPECT_NEAR(alike.distance, 0.1, 1e-12);
    EXPECT_NEAR(alike.chance->mean, (9.0 / 9.0 + 1.0) / 10.0, 1e-12);
    EXPECT_NEAR(alike.chance->probability, (1.0 + 10.0) / 11.0, 1e-12);
    const DistributionDistance strange = distribution_distance({{time_in(89)}}, ten);
    EXPECT_NEAR(strange.distance, 1.0, 1e-12);
    EXPECT_NEAR(strange.chance->probability, 2.0 / 11.0, 1e-12);
    EXPECT_FALSE(distribution_distance({{time_in(10)}}, Falls(9, {time_in(10)})).by_falls);
}

TEST(DistributionDistance, SaysNothingOfChanceForFewerThanThreePieces) {
    const DistributionDistance result =
        distribution_distance({{time_in(10), time_in(20)}}, {{time_in(10), time_in(30), time_in(40)}});
    EXPECT_FALSE(result.chance);
    EXPECT_NEAR(result.distance, 2.0 / 3.0, 1e-12);
}

}  // namespace
}  // namespace samara
