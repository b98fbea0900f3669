#include "samara/kirchhoff/solvers/block_solver.hpp"

namespace samara {
namespace {

using Basis = Eigen::MatrixXd;  // one direction a column

/// Directions and their images under the matrix, the images orthonormal.
class ImageSpace {
  public:
    explicit ImageSpace(Eigen::Index rows) : directions_(rows, 0), images_(rows, 0) {}

    /// Adds the directions whose images are new; returns how many of the last columns those are.
    Eigen::Index extend(Basis directions, Basis images) {
        constexpr double independent = 1e-8;
        const Eigen::VectorXd norms = images.colwise().norm();
        for (int pass = 0; pass < 2; ++pass) {  // twice: once is not orthogonal to rounding
            const Basis overlap = images_.transpose() * images;
            images.noalias() -= images_ * overlap;
            directions.noalias() -= directions_ * overlap;
        }
        const Eigen::Index before = images_.cols();
        for (Eigen::Index k = 0; k < images.cols(); ++k) {
            for (int pass = 0; pass < 2; ++pass) {
                const Eigen::Index added = images_.cols() - before;
                const Eigen::VectorXd overlap = images_.rightCols(added).transpose() * images.col(k);
                images.col(k) -= images_.rightCols(added) * overlap;
                directions.col(k) -= directions_.rightCols(added) * overlap;
            }
            const double rest = images.col(k).norm();
            if (!(rest > independent * norms[k])) continue;
            append(directions_, directions.col(k) / rest);
            append(images_, images.col(k) / rest);
        }
        return images_.cols() - before;
    }

    [[nodiscard]] const Basis& directions() const { return directions_; }
    [[nodiscard]] const Basis& images() const { return images_; }

  private:
    static void append(Basis& basis, const Eigen::VectorXd& column) {
        basis.conservativeResize(Eigen::NoChange, basis.cols() + 1);
        basis.rightCols<1>() = column;
    }

    Basis directions_;
    Basis images_;
};

}  // namespace

BlockSolution solve_block(const std::function<SixColumns(const SixColumns&)>& multiply,
                          const SixColumns& right_hand_sides, const BlockSolverOptions& options) {
    constexpr double least_share = 1e-3;
    BlockSolution result{SixColumns::Zero(right_hand_sides.rows(), 6), 0, false};
    Basis residual = right_hand_sides;
    const Eigen::RowVectorXd norms = right_hand_sides.colwise().norm();
    const Eigen::RowVectorXd targets = options.tolerance * norms.cwiseMax(least_share * norms.maxCoeff());
    ImageSpace space(right_hand_sides.rows());
    for (;;) {
        SixColumns open = SixColumns::Zero(residual.rows(), 6);
        result.converged = true;
        for (Eigen::Index k = 0; k < 6; ++k) {
            if (!(residual.col(k).norm() > targets[k])) continue;
            open.col(k) = residual.col(k);
            result.converged = false;
        }
        if (result.converged || result.iterations >= options.most_iterations) return result;
        if (options.precondition) open = options.precondition(open, result.iterations);
        const Eigen::Index added = space.extend(open, multiply(open));
        ++result.iterations;
        if (added == 0) return result;
        const Basis share = space.images().rightCols(added).transpose() * residual;
        residual.noalias() -= space.images().rightCols(added) * share;
        result.columns += space.directions().rightCols(added) * share;
    }
}

}  // namespace samara
