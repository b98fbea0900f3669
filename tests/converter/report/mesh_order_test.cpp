#include "converter/report/mesh_order.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace samara {
namespace {

/// Returns the values of a law whose error falls with the cells' edge to the power `order`.
std::array<double, 3> by_law(const std::array<double, 3>& cells, double order) {
    std::array<double, 3> values{};
    for (std::size_t i = 0; i < 3; ++i) values[i] = 0.4 + 2.0 * std::pow(cells[i], -order / 3.0);
    return values;
}

TEST(MeshOrder, IsThatOfThePowerLawAlsoWhereTheMeshesAreUnevenlySpaced) {
    const std::array<double, 3> cells = {6000.0, 19000.0, 46000.0};
    for (const double true_order : {0.7, 1.0, 2.0, 3.0}) {
        const std::array<double, 3> values = by_law(cells, true_order);
        const auto found = observed_order(cells, values);
        ASSERT_TRUE(found) << true_order;
        EXPECT_NEAR(found->order, true_order, 1e-6);
        EXPECT_NEAR(found->uncertainty, 1.25 * (values[2] - 0.4) / values[2], 1e-6);
    }
}

TEST(MeshOrder, OfTheExampleOfCelikAndOthersIsTheirs) {
    // Their table 1, first column: cells 18,000, 8,000 and 4,500 in two dimensions, whose edges are in the
    // ratios 1.5 and 1.333; here with as many cells in three.
    const double coarse = 4500.0;
    const auto found = observed_order(
        {coarse, coarse * std::pow(8000.0 / 4500.0, 1.5), coarse * std::pow(18000.0 / 4500.0, 1.5)},
        {5.863, 5.972, 6.063});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->order, 1.53, 0.01);
    EXPECT_NEAR(found->uncertainty, 0.022, 0.001);
}

TEST(MeshOrder, DoesNotExistWhereTheValueOscillatesOrDiverges) {
    EXPECT_FALSE(observed_order({1000.0, 8000.0, 64000.0}, {0.4, 0.5, 0.45}));
    EXPECT_FALSE(observed_order({1000.0, 8000.0, 64000.0}, {0.4, 0.41, 0.43}));
    EXPECT_FALSE(observed_order({1000.0, 8000.0, 64000.0}, {0.4, 0.4, 0.4}));
    EXPECT_FALSE(observed_order({8000.0, 8000.0, 8000.0}, {0.4, 0.41, 0.415}));
}

}  // namespace
}  // namespace samara
