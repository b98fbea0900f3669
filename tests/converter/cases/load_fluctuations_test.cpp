#include "converter/cases/load_fluctuations.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

/// An Ornstein-Uhlenbeck process of that rms and correlation time, exact at its steps.
std::vector<double> noise(double rms, double time, double step, std::size_t count, unsigned seed) {
    std::mt19937 generator(seed);
    std::normal_distribution<double> normal;
    const double kept = std::exp(-step / time);
    std::vector<double> values = {rms * normal(generator)};
    while (values.size() < count) {
        values.push_back(kept * values.back() + rms * std::sqrt(1.0 - kept * kept) * normal(generator));
    }
    return values;
}

TEST(SeriesFluctuation, OfANoiseHasItsRmsAndCorrelationTimeWithinItsErrors) {
    for (const unsigned seed : {1U, 2U, 3U}) {
        std::vector<double> values = noise(0.3, 2.0, 0.1, 12'000, seed);
        for (double& value : values) value += 5.0;
        const SeriesFluctuation found = fluctuation_of(values, 0.1);
        EXPECT_NEAR(found.mean.value, 5.0, 4.0 * found.mean.error);
        EXPECT_NEAR(found.rms.value, 0.3, 4.0 * found.rms.error);
        EXPECT_NEAR(found.correlation_time.value, 2.0, 4.0 * found.correlation_time.error);
        EXPECT_LT(found.rms.error, 0.03);
        EXPECT_LT(found.correlation_time.error, 0.5);
    }
}

TEST(SeriesFluctuation, OfAnOscillationHasItsPeakAndAnIntegralOfAQuarterPeriod) {
    std::vector<double> values;
    for (int i = 0; i < 8000; ++i) values.push_back(0.2 * std::sin(2.0 * std::numbers::pi * 0.17 * 0.05 * i));
    const SeriesFluctuation found = fluctuation_of(values, 0.05);
    ASSERT_TRUE(found.peak_frequency.has_value());
    EXPECT_NEAR(*found.peak_frequency, 0.17, 0.002);
    EXPECT_NEAR(found.rms.value, 0.2 / std::numbers::sqrt2, 1e-3);
    // The integral of the cosine to its first zero.
    EXPECT_NEAR(found.correlation_time.value, 1.0 / (2.0 * std::numbers::pi * 0.17), 0.02);
}

TEST(SeriesFluctuation, HasASpectrumWhoseIntegralIsTheVariance) {
    const std::vector<double> values = noise(0.7, 1.0, 0.1, 20'000, 7);
    const SeriesFluctuation found = fluctuation_of(values, 0.1);
    double integral = 0.0;
    for (const double power : found.spectrum.power) integral += power * found.spectrum.step;
    EXPECT_NEAR(integral, found.rms.value * found.rms.value, 0.05 * integral);
}

TEST(SeriesFluctuation, OfAConstantIsNone) {
    const SeriesFluctuation found = fluctuation_of(std::vector<double>(100, 3.0), 0.1);
    EXPECT_EQ(found.rms.value, 0.0);
    EXPECT_EQ(found.correlation_time.value, 0.0);
    EXPECT_FALSE(found.peak_frequency.has_value());
}

/// An unsteady case whose force oscillates along x, about 0.4, and whose moment about z.
class LoadFluctuationsOfACase : public testing::Test {
  protected:
    LoadFluctuationsOfACase() {
        write_parameters("backward");
        std::string force = "# Time total_x total_y total_z\n";
        std::string moment = force;
        for (int i = 1; i <= 3000; ++i) {
            const double time = 0.02 * i;
            const double swing = std::sin(2.0 * std::numbers::pi * 0.2 * time);
            force += fmt::format("{} {:.9g} 0 0\n", time, -0.4 + 0.1 * swing);
            moment += fmt::format("{} 0 0 {:.9g}\n", time, 0.05 * swing);
        }
        static_cast<void>(folder_.file("case/postProcessing/forces/0/force.dat", force));
        static_cast<void>(folder_.file("case/postProcessing/forces/0/moment.dat", moment));
    }
    void write_parameters(const char* rate) {
        static_cast<void>(
            folder_.file("case/parameters",
                         fmt::format("direction (1 0 0);\nreynoldsNumber 10000;\nrateOfChange {};\n", rate)));
    }

    test::TemporaryFolder folder_;
};

TEST_F(LoadFluctuationsOfACase, AreCoefficientsOfTheCrossSection) {
    const LoadFluctuations found = reduce_fluctuations(folder_ / "case");
    const double per_force = 8.0 / std::numbers::pi;
    EXPECT_EQ(found.direction, Vector3d::UnitX());
    EXPECT_EQ(found.reynolds_number, 1e4);
    EXPECT_NEAR(found.begin, 20.0, 0.02);
    EXPECT_EQ(found.end, 60.0);
    EXPECT_NEAR(found.components[0].mean.value, -0.4 * per_force, 1e-3);
    EXPECT_NEAR(found.components[0].rms.value, 0.1 / std::numbers::sqrt2 * per_force, 1e-3);
    EXPECT_NEAR(found.components[5].rms.value, 0.05 / std::numbers::sqrt2 * per_force, 1e-3);
    EXPECT_EQ(found.components[1].rms.value, 0.0);
    EXPECT_NEAR(found.components[0].peak_frequency.value(), 0.2, 0.01);
    EXPECT_NEAR(reduce_fluctuations(folder_ / "case", 40.0).begin, 40.0, 0.02);
}

TEST_F(LoadFluctuationsOfACase, AreWrittenRowByRow) {
    const std::vector<LoadFluctuations> cases = {reduce_fluctuations(folder_ / "case")};
    EXPECT_THAT(fluctuations_csv(cases), HasSubstr("case,1,0,0,10000,20,60,force_x,-1.01859,"));
    EXPECT_THAT(fluctuation_spectra_csv(cases), HasSubstr("case,component,frequency,power\ncase,force_x,0,"));
}

TEST_F(LoadFluctuationsOfACase, AreNotOfASteadyOneNorOfAFewSteps) {
    const auto error = [&](const std::optional<double>& begin) {
        return test::error_of([&] { (void)reduce_fluctuations(folder_ / "case", begin); });
    };
    EXPECT_THAT(error(59.5), HasSubstr("but fluctuations need 60"));
    write_parameters("steadyState");
    EXPECT_THAT(error({}), HasSubstr("the case is steady"));
}

}  // namespace
}  // namespace samara
