#include "samara/kirchhoff/block_gmres.hpp"

#include <cmath>
#include <vector>

#include <Eigen/Jacobi>
#include <Eigen/QR>

namespace samara {
namespace {

/// The Krylov space of one right-hand side, with the Hessenberg matrix kept triangular by rotations.
class KrylovSpace {
  public:
    KrylovSpace(const Eigen::VectorXd& right_hand_side, double tolerance, int most_iterations)
        : triangle_(Eigen::MatrixXd::Zero(most_iterations + 1, most_iterations)),
          projected_(Eigen::VectorXd::Zero(most_iterations + 1)) {
        const double norm = right_hand_side.norm();
        target_ = tolerance * norm;
        projected_[0] = norm;
        converged_ = norm == 0.0;
        basis_.push_back(converged_ ? right_hand_side : Eigen::VectorXd(right_hand_side / norm));
    }

    [[nodiscard]] bool converged() const { return converged_; }
    [[nodiscard]] const Eigen::VectorXd& last() const { return basis_.back(); }

    /// Takes A times last() and enlarges the space by it.
    void extend(Eigen::VectorXd image) {
        const Eigen::Index column = size_;
        for (Eigen::Index row = 0; row <= column; ++row) {
            const Eigen::VectorXd& old = basis_[static_cast<std::size_t>(row)];
            triangle_(row, column) = old.dot(image);
            image -= triangle_(row, column) * old;
        }
        const double rest = image.norm();
        triangle_(column + 1, column) = rest;
        for (Eigen::Index row = 0; row < column; ++row) {
            triangle_.col(column).applyOnTheLeft(row, row + 1,
                                                 rotations_[static_cast<std::size_t>(row)].adjoint());
        }
        Eigen::JacobiRotation<double> rotation;
        rotation.makeGivens(triangle_(column, column), rest);
        triangle_.col(column).applyOnTheLeft(column, column + 1, rotation.adjoint());
        projected_.applyOnTheLeft(column, column + 1, rotation.adjoint());
        rotations_.push_back(rotation);
        ++size_;
        converged_ = std::abs(projected_[size_]) <= target_ || rest == 0.0;
        if (!converged_) basis_.push_back(image / rest);
    }

    [[nodiscard]] Eigen::VectorXd solution() const {
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(basis_.front().size());
        if (size_ == 0) return sum;
        const Eigen::VectorXd weights = triangle_.topLeftCorner(size_, size_)
                                            .triangularView<Eigen::Upper>()
                                            .solve(projected_.head(size_));
        for (Eigen::Index i = 0; i < size_; ++i) sum += weights[i] * basis_[static_cast<std::size_t>(i)];
        return sum;
    }

  private:
    std::vector<Eigen::VectorXd> basis_;
    std::vector<Eigen::JacobiRotation<double>> rotations_;
    Eigen::MatrixXd triangle_;
    Eigen::VectorXd projected_;
    Eigen::Index size_ = 0;
    double target_ = 0.0;
    bool converged_ = false;
};

}  // namespace

std::optional<Columns> block_gmres(const std::function<Columns(const Columns&)>& multiply,
                                   const Columns& right_hand_sides, double tolerance, int most_iterations) {
    std::vector<KrylovSpace> spaces;
    for (Eigen::Index c = 0; c < right_hand_sides.cols(); ++c) {
        spaces.emplace_back(right_hand_sides.col(c), tolerance, most_iterations);
    }
    Columns block(right_hand_sides.rows(), right_hand_sides.cols());
    for (int iteration = 0;; ++iteration) {
        bool all_converged = true;
        for (std::size_t c = 0; c < spaces.size(); ++c) {
            all_converged = all_converged && spaces[c].converged();
            block.col(static_cast<Eigen::Index>(c)) = spaces[c].last();
        }
        if (all_converged) break;
        if (iteration == most_iterations) return std::nullopt;
        const Columns images = multiply(block);
        for (std::size_t c = 0; c < spaces.size(); ++c) {
            if (!spaces[c].converged()) spaces[c].extend(images.col(static_cast<Eigen::Index>(c)));
        }
    }
    Columns solutions(right_hand_sides.rows(), right_hand_sides.cols());
    for (std::size_t c = 0; c < spaces.size(); ++c) {
        solutions.col(static_cast<Eigen::Index>(c)) = spaces[c].solution();
    }
    return solutions;
}

}  // namespace samara
