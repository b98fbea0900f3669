#include "samara/analysis/metrics/spectrum.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace samara {
namespace {

constexpr double time_step = 0.01;

std::vector<double> tone(double frequency, double amplitude, std::size_t count) {
    std::vector<double> values;
    for (std::size_t i = 0; i < count; ++i) {
        const double time = time_step * static_cast<double>(i);
        values.push_back(3.0 + amplitude * std::sin(2.0 * std::numbers::pi * frequency * time + 0.4));
    }
    return values;
}

double integral_of(const Spectrum& spectrum) {
    double sum = 0.0;
    for (const double power : spectrum.power) sum += power * spectrum.step;
    return sum;
}

TEST(Spectrum, PeaksAtATonesFrequencyBetweenItsSteps) {
    for (const double frequency : {1.234, 2.5, 7.77}) {
        const Spectrum spectrum = power_spectrum(tone(frequency, 0.7, 400), time_step, 400);
        EXPECT_NEAR(peak_frequency(spectrum, 0.5).value(), frequency, 2e-3);
        EXPECT_LE(8.0 * spectrum.step, spectrum.resolution);
    }
}

TEST(Spectrum, IntegratesToTheVarianceWithoutTheMean) {
    for (const std::size_t segment : {500U, 1600U, 5000U}) {
        const Spectrum spectrum = power_spectrum(tone(4.0, 0.7, 1600), time_step, segment);
        EXPECT_NEAR(integral_of(spectrum), 0.5 * 0.7 * 0.7, 2e-3) << segment;
    }
}

TEST(Spectrum, HasTheStatedWidthAtHalfHeight) {
    const Spectrum spectrum = power_spectrum(tone(5.0, 1.0, 400), time_step, 400);
    double width = 0.0;
    double highest = 0.0;
    for (const double power : spectrum.power) highest = std::max(highest, power);
    for (const double power : spectrum.power) width += power > 0.5 * highest ? spectrum.step : 0.0;
    EXPECT_NEAR(width, spectrum.resolution, 2.0 * spectrum.step);
}

TEST(Spectrum, WhatIsLeftOutDoesNotCount) {
    std::vector<double> values = tone(3.0, 0.5, 600);
    const LeftOut left_out{200, 300};
    const Spectrum before = power_spectrum(values, time_step, 600, left_out);
    for (std::size_t i = left_out.begin; i < left_out.end; ++i) values[i] = 1e3;
    EXPECT_EQ(power_spectrum(values, time_step, 600, left_out).power, before.power);
    EXPECT_NEAR(peak_frequency(before, 1.0).value(), 3.0, 0.02);
}

TEST(Spectrum, OfAConstantHasNoPeak) {
    EXPECT_FALSE(
        peak_frequency(power_spectrum(std::vector<double>(100, 0.0), time_step, 100), 0.5).has_value());
}

TEST(Spectrum, OfTwoTonesThePeakIsTheHigherOneAboveTheLowestFrequency) {
    std::vector<double> values = tone(1.0, 2.0, 1000);
    const std::vector<double> second = tone(4.0, 0.5, 1000);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += second[i];
    const Spectrum spectrum = power_spectrum(values, time_step, 1000);
    EXPECT_NEAR(peak_frequency(spectrum, 0.5).value(), 1.0, 5e-3);
    EXPECT_NEAR(peak_frequency(spectrum, 2.0).value(), 4.0, 5e-3);
}

}  // namespace
}  // namespace samara
