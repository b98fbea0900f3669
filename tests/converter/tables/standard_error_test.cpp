#include "converter/tables/standard_error.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace samara {
namespace {

/// x_i = r x_{i-1} + noise, of unit variance.
std::vector<double> correlated_series(double correlation, std::size_t length, unsigned seed) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> normal;
    std::vector<double> series;
    double value = normal(generator);
    for (std::size_t i = 0; i < length; ++i) {
        series.push_back(value);
        value = correlation * value + std::sqrt(1.0 - correlation * correlation) * normal(generator);
    }
    return series;
}

TEST(StandardError, OfAConstantIsZero) {
    EXPECT_EQ(standard_error(std::vector<double>(50, 0.25)), 0.0);
    EXPECT_EQ(mean(std::vector<double>(50, 0.25)), 0.25);
    EXPECT_EQ(standard_error({1.0}), 0.0);
}

TEST(StandardError, OfTwoValuesHoldsHalfTheirDifferenceTwice) {
    EXPECT_DOUBLE_EQ(standard_error({1.0, 1.5}), 0.25 * std::sqrt(2.0));
}

TEST(StandardError, OfACorrelatedSeriesIsThatOfItsMean) {
    constexpr double correlation = 0.8;
    constexpr std::size_t length = 10000;
    double sum = 0.0;
    constexpr unsigned runs = 1000;
    for (unsigned run = 0; run < runs; ++run)
        sum += standard_error(correlated_series(correlation, length, run));
    // The mean of a long first-order autoregressive series of unit variance has the variance
    // (1 + r) / (1 - r) / n =: s^2. Half the difference of the halves' means is s times a normal deviate z;
    // the mean of the root of 1 + z^2 is 1.354.
    const double exact = std::sqrt((1.0 + correlation) / (1.0 - correlation) / static_cast<double>(length));
    EXPECT_NEAR(sum / runs, 1.354 * exact, 0.06 * exact);
}

TEST(StandardError, OfADriftHoldsHalfTheDifferenceOfItsHalves) {
    std::vector<double> series(100);
    for (std::size_t i = 0; i < series.size(); ++i) series[i] = 3.0 + 0.02 * static_cast<double>(i);
    // The halves differ by 1, the means of the ten batches by 0.2 from one to the next.
    const double batches = std::sqrt(0.04 * 82.5 / 90.0);
    EXPECT_NEAR(standard_error(series), std::hypot(0.5, batches), 1e-12);
}

TEST(StandardError, OfAStepInTheMiddleIsSeenHoweverStillTheSeriesIsElse) {
    std::vector<double> series(200, 1.0);
    std::fill(series.begin() + 100, series.end(), 1.1);
    EXPECT_GE(standard_error(series), 0.05);
}

TEST(StandardError, OfAnOscillationFallsWithItsLength) {
    const auto oscillation = [](std::size_t length) {
        std::vector<double> series(length);
        for (std::size_t i = 0; i < length; ++i) series[i] = std::sin(0.9 * static_cast<double>(i));
        return standard_error(series);
    };
    EXPECT_LT(oscillation(900), 0.3 * oscillation(100));
}

}  // namespace
}  // namespace samara
