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

/// The rms change of the mean from 50 iterations to the next 50, over the rms of the error that the first 50
/// state.
double change_over_error(double correlation, double (*error)(const std::vector<double>&)) {
    double changes = 0.0;
    double errors = 0.0;
    for (unsigned run = 0; run < 1000; ++run) {
        const std::vector<double> both = correlated_series(correlation, 100, run);
        const std::vector<double> first(both.begin(), both.begin() + 50);
        const std::vector<double> second(both.begin() + 50, both.end());
        changes += std::pow(mean(second) - mean(first), 2.0);
        errors += std::pow(error(first), 2.0);
    }
    return std::sqrt(changes / errors);
}

// Iterations that remember about as many before them as there are in the tail, as a wake's do.
TEST(TailError, HoldsWhatARunOfTwiceTheLengthChanges) {
    const double correlation = std::exp(-1.0 / 30.0);
    EXPECT_GT(change_over_error(correlation, standard_error), 1.8);
    EXPECT_NEAR(change_over_error(correlation, tail_error), 1.0, 0.3);
}

TEST(TailError, OfALongSeriesComesToThatOfItsBatches) {
    const std::vector<double> series = correlated_series(0.99, 1'000'000, 1);
    EXPECT_NEAR(tail_error(series), standard_error(series), 0.5 * standard_error(series));
    EXPECT_EQ(tail_error(std::vector<double>(50, 0.25)), 0.0);
    EXPECT_EQ(tail_error({1.0}), 0.0);
}

TEST(Student, WidensByHalfOfTheTabulatedQuantiles) {
    // t at 95.45 %, two-sided: GUM (JCGM 100:2008), table G.2.
    EXPECT_NEAR(2.0 * student_widening(1), 13.97, 0.005);
    EXPECT_NEAR(2.0 * student_widening(2), 4.53, 0.005);
    EXPECT_NEAR(2.0 * student_widening(3), 3.31, 0.005);
    EXPECT_NEAR(2.0 * student_widening(5), 2.65, 0.005);
    EXPECT_NEAR(2.0 * student_widening(10), 2.28, 0.005);
    EXPECT_NEAR(2.0 * student_widening(45), 2.06, 0.005);
}

TEST(Student, HasNothingToWidenWhereNothingWasEstimated) {
    EXPECT_EQ(student_widening(0), 1.0);
}

TEST(Student, TendsToOne) {
    EXPECT_NEAR(student_widening(100'000), 1.0, 1e-4);
}

}  // namespace
}  // namespace samara
