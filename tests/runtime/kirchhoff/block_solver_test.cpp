#include "samara/kirchhoff/solvers/block_solver.hpp"

#include <random>

#include <Eigen/LU>
#include <gtest/gtest.h>

namespace samara {
namespace {

/// Numbers in [-1, 1]; not std::uniform_real_distribution: its values differ between libraries.
Eigen::MatrixXd random_matrix(Eigen::Index rows, Eigen::Index columns, unsigned seed) {
    std::mt19937 generator(seed);
    return Eigen::MatrixXd::NullaryExpr(
        rows, columns, [&] { return 2.0 * static_cast<double>(generator()) / 4294967295.0 - 1.0; });
}

TEST(BlockSolver, SolvesSixRightHandSidesAtOnce) {
    const Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(80, 80) + 0.05 * random_matrix(80, 80, 1);
    const SixColumns exact = random_matrix(80, 6, 2);
    const auto multiply = [&](const SixColumns& columns) -> SixColumns { return matrix * columns; };
    const BlockSolution solution = solve_block(multiply, matrix * exact, {1e-12, 50, {}});
    EXPECT_TRUE(solution.converged);
    EXPECT_LT((solution.columns - exact).norm(), 1e-10 * exact.norm());
    EXPECT_LE(solution.iterations, 14);  // six directions a product span all 80 dimensions
}

TEST(BlockSolver, TakesColumnsThatAreZeroOrDependOnEachOther) {
    const Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(40, 40) + 0.05 * random_matrix(40, 40, 3);
    SixColumns exact = random_matrix(40, 6, 4);
    exact.col(1).setZero();
    exact.col(4) = 2.0 * exact.col(0) - exact.col(5);
    const auto multiply = [&](const SixColumns& columns) -> SixColumns { return matrix * columns; };
    const BlockSolution solution = solve_block(multiply, matrix * exact, {1e-12, 50, {}});
    EXPECT_TRUE(solution.converged);
    EXPECT_LT((solution.columns - exact).norm(), 1e-10 * exact.norm());
}

TEST(BlockSolver, NeedsOneProductWithTheInverseAsPreconditioner) {
    const Eigen::MatrixXd matrix = random_matrix(30, 30, 5);
    const Eigen::MatrixXd inverse = matrix.inverse();
    const SixColumns exact = random_matrix(30, 6, 6);
    const auto multiply = [&](const SixColumns& columns) -> SixColumns { return matrix * columns; };
    const auto precondition = [&](const SixColumns& columns, int) -> SixColumns { return inverse * columns; };
    const BlockSolution solution = solve_block(multiply, matrix * exact, {1e-8, 50, precondition});
    EXPECT_TRUE(solution.converged);
    EXPECT_EQ(solution.iterations, 1);
}

TEST(BlockSolver, SaysWhenItDidNotConverge) {
    const Eigen::MatrixXd matrix = random_matrix(300, 300, 7);
    const auto multiply = [&](const SixColumns& columns) -> SixColumns { return matrix * columns; };
    const BlockSolution solution = solve_block(multiply, random_matrix(300, 6, 8), {1e-10, 5, {}});
    EXPECT_FALSE(solution.converged);
    EXPECT_EQ(solution.iterations, 5);
}

}  // namespace
}  // namespace samara
