#include <cmath>

#include <gtest/gtest.h>

#include "converter/tables/table_filling.hpp"

namespace samara {
namespace {

// A drag that is quadratic in log Re, k an exponential of it, and one chi.
LoadEntry entry_at(double reynolds_number) {
    const double x = std::log10(reynolds_number);
    LoadEntry entry;
    entry.force = {x * x, 0.0, 0.0};
    entry.turbulent_kinetic_energy = std::exp(0.1 * x * x);
    entry.dissipation_rate = 0.5 * entry.turbulent_kinetic_energy;
    return entry;
}

TEST(ReynoldsInterpolation, PredictsTheErrorInTheMiddleOfTheIntervals) {
    const std::vector<double> numbers = {1e2, 1e3, 1e4};
    std::vector<std::vector<LoadEntry>> nodes;
    for (const double number : numbers) nodes.push_back({entry_at(number)});
    const LoadEntryError variance = reynolds_interpolation_variance(numbers, nodes);
    const double middle = std::sqrt(1e3 * 1e4);
    const double lookup = 0.5 * (nodes[1][0].force.x() + nodes[2][0].force.x());
    const double exact = lookup - entry_at(middle).force.x();
    // Only one component in three has the error; the result is their root mean square.
    EXPECT_NEAR(std::sqrt(3.0 * variance.force.x()), exact, 1e-12);
    EXPECT_GT(variance.turbulent_kinetic_energy, 0.0);
    // Errors are of the roots.
    EXPECT_NEAR(variance.dissipation_rate, 0.5 * variance.turbulent_kinetic_energy, 1e-12);
    EXPECT_EQ(variance.moment.norm(), 0.0);
}

TEST(ReynoldsInterpolation, SaysNothingOfTwoReynoldsNumbers) {
    const LoadEntryError variance =
        reynolds_interpolation_variance({1e2, 1e3}, {{entry_at(1e2)}, {entry_at(1e3)}});
    EXPECT_EQ(variance.force.norm(), 0.0);
    EXPECT_EQ(variance.turbulent_kinetic_energy, 0.0);
}

TEST(ReynoldsInterpolation, LeavesTurbulenceAloneWhereOneNumberIsLaminar) {
    std::vector<std::vector<LoadEntry>> nodes = {{entry_at(1e2)}, {entry_at(1e3)}, {entry_at(1e4)}};
    nodes[0][0].turbulent_kinetic_energy = nodes[0][0].dissipation_rate = 0.0;
    const LoadEntryError variance = reynolds_interpolation_variance({1e2, 1e3, 1e4}, nodes);
    EXPECT_EQ(variance.turbulent_kinetic_energy, 0.0);
    EXPECT_GT(variance.force.x(), 0.0);
}

}  // namespace
}  // namespace samara
