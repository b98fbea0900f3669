#include "samara/kirchhoff/operators/compressed_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include "samara/kirchhoff/operators/cross_approximation.hpp"
#include "samara/kirchhoff/operators/hypersingular.hpp"
#include "samara/kirchhoff/panels/flat_triangle_integrals.hpp"
#include "samara/kirchhoff/panels/linear_elements.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

constexpr std::size_t leaf_size = 64;

/// Columns that are all different and the same everywhere.
CurlColumns some_columns(std::size_t rows) {
    CurlColumns columns(static_cast<Eigen::Index>(rows), 18);
    for (Eigen::Index i = 0; i < columns.rows(); ++i) {
        for (Eigen::Index j = 0; j < 18; ++j) {
            columns(i, j) =
                static_cast<float>(std::sin(1.7 * static_cast<double>(i) + 0.3 * static_cast<double>(j * j)));
        }
    }
    return columns;
}

double product_error(const Surface& surface, double tolerance) {
    const LinearElements elements = linear_elements(surface, leaf_size);
    const SingleLayerEntries entries(elements.triangles);
    const CompressedMatrix compressed(entries, elements.tree, tolerance, 2);
    const CurlColumns columns = some_columns(entries.size());
    const Eigen::MatrixXd exact = dense_single_layer(entries, 2) * columns.cast<double>();
    return (compressed.times(columns, 2).cast<double>() - exact).norm() / exact.norm();
}

TEST(SingleLayerEntries, OfDistantPairsAgreeWithTheNearExactIntegral) {
    const LinearElements elements = linear_elements(test::ellipsoid({1.0, 1.5, 0.6}, 2), leaf_size);
    const SingleLayerEntries entries(elements.triangles);
    std::vector<double> row(entries.size());
    entries.fill_row(100, 0, entries.size(), row.data());
    for (std::size_t j = 0; j < row.size(); ++j) {
        const double exact =
            pair_potential(elements.triangles[100], elements.triangles[j]) / (4.0 * std::numbers::pi);
        EXPECT_NEAR(row[j] / exact, 1.0, 6e-6) << j;
    }
}

TEST(SingleLayerEntries, AreTheSameWhereverTheRowStarts) {
    const LinearElements elements = linear_elements(test::ellipsoid({1.0, 1.5, 0.6}, 2), leaf_size);
    const SingleLayerEntries entries(elements.triangles);
    std::vector<double> whole(entries.size());
    std::vector<double> part(7);
    entries.fill_row(5, 0, entries.size(), whole.data());
    entries.fill_row(5, 33, 40, part.data());
    for (std::size_t j = 0; j < 7; ++j) EXPECT_NEAR(part[j] / whole[33 + j], 1.0, 1e-5);
}

TEST(SingleLayerMatrix, IsPositiveDefinite) {
    const LinearElements elements = linear_elements(test::box({1.0, 1.0, 0.01}, 3), leaf_size);
    const RowMatrix matrix = dense_single_layer(SingleLayerEntries(elements.triangles), 1);
    EXPECT_EQ((matrix - matrix.transpose()).norm(), 0.0);
    EXPECT_EQ(Eigen::LLT<Eigen::MatrixXd>(matrix).info(), Eigen::Success);
}

TEST(ClusterTree, KeepsAllTrianglesAndNeighboursTogether) {
    const std::vector<FlatTriangle> triangles = flat_triangles(test::icosphere(3));
    const ClusterTree tree = cluster_tree(triangles, 50);
    std::vector<bool> seen(triangles.size(), false);
    for (const std::size_t t : tree.order) seen[t] = true;
    EXPECT_EQ(std::count(seen.begin(), seen.end(), true), static_cast<std::ptrdiff_t>(triangles.size()));
    std::size_t in_leaves = 0;
    for (const Cluster& cluster : tree.clusters) {
        if (!cluster.is_leaf()) continue;
        in_leaves += cluster.size();
        EXPECT_LE(cluster.size(), 50U);
        EXPECT_LT(box_diameter(cluster), 1.2);
    }
    EXPECT_EQ(in_leaves, triangles.size());
}

TEST(CompressedMatrix, TimesColumnsIsTheWholeMatrixTimesThem) {
    const Surface surface = test::ellipsoid({1.0, 2.0, 4.0}, 3);
    EXPECT_LT(product_error(surface, 1e-3), 1e-3);
    EXPECT_LT(product_error(surface, 1e-5), 1e-5);
}

TEST(CompressedMatrix, HoldsOnThinPlatesWhereManyRowsAreAlike) {
    // Ten layers of slivers on each rim: approximations that look at pivots alone end too soon there.
    EXPECT_LT(product_error(test::box({1.0, 1.0, 1e-4}, 10), 1e-5), 2e-5);
    EXPECT_LT(product_error(test::ellipsoid({1.0, 1.0, 1e-4}, 3), 1e-5), 2e-5);
}

TEST(CompressedMatrix, PartIsTheRowsAndColumnsOfTheTriangles) {
    const LinearElements elements = linear_elements(test::ellipsoid({1.0, 2.0, 4.0}, 3), leaf_size);
    const SingleLayerEntries entries(elements.triangles);
    std::vector<std::size_t> triangles;
    for (std::size_t t = 3; t < entries.size(); t += 7) triangles.push_back(t);
    const Eigen::MatrixXd exact = dense_single_layer(entries, 2)(triangles, triangles);
    const Eigen::MatrixXd part = CompressedMatrix(entries, elements.tree, 1e-5, 2).part(triangles);
    EXPECT_LT((part - exact).norm(), 2e-5 * exact.norm());
}

TEST(CompressedMatrix, DoesNotDependOnTheNumberOfThreads) {
    const LinearElements elements = linear_elements(test::icosphere(3), leaf_size);
    const SingleLayerEntries entries(elements.triangles);
    const CurlColumns columns = some_columns(entries.size());
    const CurlColumns one = CompressedMatrix(entries, elements.tree, 1e-5, 1).times(columns, 1);
    const CurlColumns three = CompressedMatrix(entries, elements.tree, 1e-5, 3).times(columns, 3);
    EXPECT_EQ(one, three);
}

TEST(CompressedMatrix, TakesLessMemoryPerTriangleTheMoreThereAre) {
    const auto share = [](int level) {
        const LinearElements elements = linear_elements(test::icosphere(level), leaf_size);
        const SingleLayerEntries entries(elements.triangles);
        const CompressedMatrix matrix(entries, elements.tree, 1e-4, 2);
        const auto count = static_cast<double>(entries.size());
        return static_cast<double>(matrix.memory()) / (4.0 * count * count);
    };
    EXPECT_LT(share(3), 0.7);
    EXPECT_LT(share(4), 0.15);
}

TEST(CrossApproximation, FindsTheRankThatTheToleranceTakes) {
    const LinearElements elements = linear_elements(test::ellipsoid({1.0, 1.0, 5.0}, 3), 200);
    const SingleLayerEntries entries(elements.triangles);
    const std::size_t count = entries.size();
    const IndexRange rows{0, 160};
    const IndexRange columns{count - 160, count};
    const auto rough = cross_approximation(entries, rows, columns, 1e-2, 80);
    const auto fine = cross_approximation(entries, rows, columns, 1e-5, 80);
    ASSERT_TRUE(rough && fine);
    EXPECT_LT(rough->rank, fine->rank);
    EXPECT_LT(fine->rank, 20U);
    EXPECT_FALSE(cross_approximation(entries, rows, columns, 1e-5, 2));
}

}  // namespace
}  // namespace samara
