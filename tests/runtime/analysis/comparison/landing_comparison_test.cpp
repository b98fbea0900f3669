#include "samara/analysis/comparison/landing_comparison.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace samara {
namespace {

using Passages = std::vector<Passage>;

Passages at(const std::vector<Vector3d>& places) {
    Passages passages;
    for (const Vector3d& place : places) passages.push_back({1.0, place});
    return passages;
}

/// Places around a centre, normal with a deviation of one on either axis.
Passages drawn(std::mt19937& generator, int count, const Vector3d& center = Vector3d::Zero(),
               double deviation = 1.0) {
    std::normal_distribution<double> normal;
    Passages passages;
    for (int i = 0; i < count; ++i) {
        const Vector3d place = center + deviation * Vector3d(normal(generator), normal(generator), 0.0);
        passages.push_back({2.0 + 0.1 * normal(generator), place});
    }
    return passages;
}

TEST(LandingComparison, TellsThePlaceTheTimeAndTheScatterOfEachSide) {
    const Passages cross = {{1.0, {3, 2, 0}}, {2.0, {1, 2, 0}}, {3.0, {2, 3, 0}}, {4.0, {2, 1, 0}}};
    const LandingComparison all = compare_landings(0.7, cross, cross);
    EXPECT_EQ(all.depth, 0.7);
    EXPECT_LT((all.motion.mean - Vector3d(2, 2, 0)).norm(), 1e-15);
    EXPECT_DOUBLE_EQ(all.motion.time.value, 2.5);
    EXPECT_DOUBLE_EQ(*all.motion.time.error, std::sqrt(5.0 / 3.0) / 2.0);
    // All four are 1 m from the mean, which is of themselves: 4/3 of their mean square.
    EXPECT_DOUBLE_EQ(all.motion.scatter.value, std::sqrt(4.0 / 3.0));
    EXPECT_NEAR(all.motion.scatter.error.value(), 0.0, 1e-7);  // whichever is left out
}

TEST(LandingComparison, KnowsTheErrorOfTheScatter) {
    std::mt19937 generator(7);
    double squares = 0.0;
    double stated = 0.0;
    constexpr int sets = 400;
    for (int i = 0; i < sets; ++i) {
        const Passages falls = drawn(generator, 12);
        const Estimate scatter =
            compare_landings(1.0, falls, at({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})).motion.scatter;
        squares += (scatter.value - std::sqrt(2.0)) * (scatter.value - std::sqrt(2.0)) / sets;
        stated += *scatter.error / sets;
    }
    EXPECT_NEAR(stated, std::sqrt(squares), 0.15 * stated);
}

TEST(LandingComparison, HasTheEnergyDistanceBetweenThePlaces) {
    // Each side in one place: twice the distance between them.
    const Passages here = at({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
    const Passages there = at({{3, 4, 0}, {3, 4, 0}, {3, 4, 0}, {3, 4, 0}});
    EXPECT_DOUBLE_EQ(compare_landings(1.0, here, there).distance, 10.0);
    EXPECT_DOUBLE_EQ(compare_landings(1.0, there, here).distance, 10.0);
    // In two places each, with other shares: 2 d (p - q)^2 for the share p here and q there, d apart.
    const Passages one = at({{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {2, 0, 0}});
    const Passages other = at({{0, 0, 0}, {2, 0, 0}, {2, 0, 0}, {2, 0, 0}});
    EXPECT_DOUBLE_EQ(compare_landings(1.0, one, other).distance, 1.0);
    const LandingComparison same = compare_landings(1.0, one, one);
    EXPECT_EQ(same.distance, 0.0);
    EXPECT_EQ(same.chance.probability, 1.0);
}

TEST(LandingComparison, GivesItsProbabilityAsOftenAsItSays) {
    std::mt19937 generator(3);
    int improbable = 0;
    constexpr int pairs = 60;
    for (int pair = 0; pair < pairs; ++pair) {
        const Passages motion = drawn(generator, 12);
        const Passages reference = drawn(generator, 24);
        improbable += compare_landings(1.0, motion, reference).chance.probability < 0.2 ? 1 : 0;
    }
    // 12 expected, with a deviation of 3.1.
    EXPECT_GT(improbable, 2);
    EXPECT_LT(improbable, 22);
}

TEST(LandingComparison, FindsAnotherCentreAndAnotherScatter) {
    std::mt19937 generator(5);
    const Passages reference = drawn(generator, 24);
    EXPECT_LT(compare_landings(1.0, drawn(generator, 24, {2, 0, 0}), reference).chance.probability, 0.01);
    EXPECT_LT(compare_landings(1.0, drawn(generator, 24, {0, 0, 0}, 4.0), reference).chance.probability,
              0.01);
}

}  // namespace
}  // namespace samara
