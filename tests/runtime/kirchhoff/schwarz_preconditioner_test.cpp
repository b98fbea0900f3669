
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include "samara/kirchhoff/operators/hypersingular.hpp"
#include "samara/kirchhoff/solvers/conjugate_gradients.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

/// A body's hypersingular matrix, and what a preconditioner for it is made from.
struct Equations {
    explicit Equations(const Surface& surface)
        : elements(linear_elements(surface, 16)),
          single_layer(dense_single_layer(SingleLayerEntries(elements.triangles), 0)),
          matrix(dense_hypersingular(elements, single_layer, 0)) {}

    [[nodiscard]] Eigen::Index size() const { return matrix.rows(); }
    [[nodiscard]] SchwarzPreconditioner preconditioner(std::size_t cluster_size, int threads = 0) const {
        const auto part = [&](const std::vector<std::size_t>& triangles) -> Eigen::MatrixXd {
            return single_layer(triangles, triangles);
        };
        return {elements, part, cluster_size, threads};
    }
    /// Six columns for which the equations have solutions, different at every node.
    [[nodiscard]] SixColumns right_hand_sides() const {
        SixColumns columns(size(), 6);
        for (Eigen::Index i = 0; i < size(); ++i) {
            const Vector3d& place = elements.nodes[static_cast<std::size_t>(i)];
            columns.row(i) << place.transpose(), place.cwiseAbs2().transpose();
        }
        remove_component_sums(elements, columns);
        return columns;
    }
    [[nodiscard]] std::optional<SolutionEnergies> solved(
        const std::function<SixColumns(const SixColumns&)>& precondition) const {
        return conjugate_gradients([&](const SixColumns& columns) -> SixColumns { return matrix * columns; },
                                   precondition, right_hand_sides(), Vector6d::Zero(), 1e-8);
    }

    LinearElements elements;
    RowMatrix single_layer;
    RowMatrix matrix;
};

/// A square plate a hundred times wider than thick.
const Equations& plate() {
    static const Equations equations(test::box({1.0, 1.0, 0.01}, 8));
    return equations;
}

Eigen::MatrixXd as_matrix(const SchwarzPreconditioner& preconditioner, Eigen::Index size) {
    Eigen::MatrixXd result(size, size);
    for (Eigen::Index first = 0; first < size; first += 6) {
        const Eigen::Index count = std::min<Eigen::Index>(6, size - first);
        SixColumns units = SixColumns::Zero(size, 6);
        for (Eigen::Index k = 0; k < count; ++k) units(first + k, k) = 1.0;
        result.middleCols(first, count) = preconditioner.apply(units, 0).leftCols(count);
    }
    return result;
}

TEST(SchwarzPreconditioner, IsSymmetricAndPositiveDefinite) {
    const Eigen::MatrixXd operation = as_matrix(plate().preconditioner(96), plate().size());
    EXPECT_LT((operation - operation.transpose()).norm(), 1e-12 * operation.norm());
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(operation, Eigen::EigenvaluesOnly);
    EXPECT_GT(eigen.eigenvalues().minCoeff(), 0.0);
}

TEST(SchwarzPreconditioner, IsTheInverseWhereOneClusterHoldsTheWholeBody) {
    const SchwarzPreconditioner preconditioner = plate().preconditioner(plate().elements.triangle_count());
    SixColumns solution = plate().right_hand_sides();
    // But for a constant, which the matrix cannot see.
    solution.rowwise() -= solution.colwise().mean();
    const SixColumns again = preconditioner.apply(plate().matrix * solution, 0);
    EXPECT_LT((again - solution).norm(), 1e-6 * solution.norm());
    EXPECT_EQ(preconditioner.memory(),
              sizeof(double) * static_cast<std::size_t>(plate().size() * plate().size()));
}

TEST(SchwarzPreconditioner, InvertsEachOfTwoBodiesThatAreFarApart) {
    Surface two = test::box({1.0, 1.0, 0.05}, 3);
    const Surface one = two;
    for (const Vector3d& vertex : one.vertices) two.vertices.push_back(vertex + Vector3d(1e4, 0.0, 0.0));
    const auto shift = static_cast<std::int32_t>(one.vertices.size());
    for (const auto& [a, b, c] : one.corners) two.corners.push_back({a + shift, b + shift, c + shift});
    const Equations equations(two);
    ASSERT_EQ(equations.elements.component_count, 2);
    const SchwarzPreconditioner preconditioner = equations.preconditioner(one.corners.size());
    SixColumns solution = equations.right_hand_sides();
    for (const std::int32_t component : {0, 1}) {
        Eigen::Array<double, 1, 6> sum = Eigen::Array<double, 1, 6>::Zero();
        double count = 0.0;
        for (Eigen::Index i = 0; i < solution.rows(); ++i) {
            if (equations.elements.component[static_cast<std::size_t>(i)] != component) continue;
            sum += solution.row(i).array();
            count += 1.0;
        }
        for (Eigen::Index i = 0; i < solution.rows(); ++i) {
            if (equations.elements.component[static_cast<std::size_t>(i)] != component) continue;
            solution.row(i).array() -= sum / count;
        }
    }
    const SixColumns again = preconditioner.apply(equations.matrix * solution, 0);
    EXPECT_LT((again - solution).norm(), 1e-5 * solution.norm());
}

TEST(SchwarzPreconditioner, CutsTheIterationsOfConjugateGradientsOnAThinPlate) {
    const auto alone = plate().solved([](const SixColumns& columns) { return columns; });
    const SchwarzPreconditioner preconditioner = plate().preconditioner(96);
    const auto helped =
        plate().solved([&](const SixColumns& columns) { return preconditioner.apply(columns, 0); });
    ASSERT_TRUE(helped);
    const int without = alone ? alone->iterations : 300;
    RecordProperty("without", without);
    RecordProperty("with", helped->iterations);
    EXPECT_LT(3 * helped->iterations, without);  // 10 and 43

    // To the solution, by the factorised matrix with the constants taken out.
    Eigen::MatrixXd regular = plate().matrix;
    regular.array() += regular.diagonal().mean() / static_cast<double>(plate().size());
    const SixColumns loads = plate().right_hand_sides();
    const Matrix6d exact = loads.transpose() * regular.llt().solve(Eigen::MatrixXd(loads));
    EXPECT_LT((helped->energies - exact).norm(), 1e-6 * exact.norm());
}

TEST(SchwarzPreconditioner, NeedsNoMoreIterationsTheThinnerThePlate) {
    const Equations thin(test::box({1.0, 1.0, 1e-4}, 8));
    const SchwarzPreconditioner of_thin = thin.preconditioner(96);
    const SchwarzPreconditioner of_plate = plate().preconditioner(96);
    const auto thinner = thin.solved([&](const SixColumns& columns) { return of_thin.apply(columns, 0); });
    const auto thicker =
        plate().solved([&](const SixColumns& columns) { return of_plate.apply(columns, 0); });
    ASSERT_TRUE(thinner && thicker);
    EXPECT_LE(thinner->iterations, 2 * thicker->iterations);
}

TEST(SchwarzPreconditioner, IsTheSameForAnyNumberOfThreads) {
    const SixColumns loads = plate().right_hand_sides();
    const SixColumns by_one = plate().preconditioner(96, 1).apply(loads, 1);
    const SixColumns by_three = plate().preconditioner(96, 3).apply(loads, 3);
    EXPECT_EQ(by_one, by_three);
}

}  // namespace
}  // namespace samara
