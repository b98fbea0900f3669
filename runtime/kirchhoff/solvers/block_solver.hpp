#pragma once

#include <functional>

#include <Eigen/Core>

namespace samara {

/// Six columns, the six numbers of a row side by side.
using SixColumns = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// The result of solve_block().
struct BlockSolution {
    SixColumns columns;
    int iterations = 0;  ///< products with the matrix
    bool converged = false;
};

/// Options of solve_block().
struct BlockSolverOptions {
    double tolerance = 1e-10;  ///< norm of each residual, relative to its right-hand side
    int most_iterations = 100;
    /// An approximate inverse of the matrix times six residuals; it may change with the number of products
    /// done so far. Where it is empty, none is used.
    std::function<SixColumns(const SixColumns& residuals, int iterations)> precondition = {};
};

/// Solves A X = B for six right-hand sides at once by the block form of the generalised conjugate residual
/// method (S. C. Eisenstat, H. C. Elman and M. H. Schultz, SIAM J. Numer. Anal. 20(2), 1983): every column is
/// minimised over the space that all six have spanned, so that fewer products are needed than with six
/// separate spaces. `multiply` returns A times six columns. A column whose right-hand side is below 1e-3 of
/// the largest is solved to the tolerance of that.
BlockSolution solve_block(const std::function<SixColumns(const SixColumns&)>& multiply,
                          const SixColumns& right_hand_sides, const BlockSolverOptions& options);

}  // namespace samara
