#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/kirchhoff/panels/linear_elements.hpp"

namespace samara {

/// Energies of the solution of A X = B.
struct SolutionEnergies {
    Matrix6d energies = Matrix6d::Zero();  ///< B^T A^-1 B
    int iterations = 0;
};

/// Computes B^T A^-1 B for a symmetric positive semidefinite A and six columns B in its range, by conjugate
/// gradients with a preconditioner, all columns at once (Hestenes and Stiefel 1952). The energies come from
/// the variational form X^T B + B^T X - X^T A X, whose error is of second order in that of X. `scales`: terms
/// that the caller adds to the energies' diagonal. A column ends where the energy that is left (its
/// preconditioned residual) is below `tolerance` times energy plus scale, or below a thousandth of that of
/// the largest of its three columns (omega or v). Returns nothing where the matrix is not positive, or 300
/// iterations do not suffice. `progress` is called with the share of the digits done.
std::optional<SolutionEnergies> conjugate_gradients(
    const std::function<SixColumns(const SixColumns&)>& multiply,
    const std::function<SixColumns(const SixColumns&)>& precondition, const SixColumns& right_hand_sides,
    const Vector6d& scales, double tolerance, const std::function<void(double)>& progress = {});

/// Additive Schwarz for the hypersingular matrix: exact inverses on overlapping clusters of nodes. A cluster
/// is a part of space, so it holds both faces of a thin body, whose modes of equal potential on both sides W
/// hardly resists.
class SchwarzPreconditioner {
  public:
    /// The single-layer matrix V of some triangles, whose indices ascend.
    using SingleLayerPart = std::function<Eigen::MatrixXd(const std::vector<std::size_t>& triangles)>;

    /// Factorises the matrix on clusters of up to `cluster_size` triangles. `single_layer` is called from
    /// several threads at once. The result does not depend on `threads` (0: all cores).
    SchwarzPreconditioner(const LinearElements& elements, const SingleLayerPart& single_layer,
                          std::size_t cluster_size, int threads);

    /// Returns the sum of the clusters' solutions for the residuals.
    [[nodiscard]] SixColumns apply(const SixColumns& residuals, int threads) const;

    /// Returns the bytes that the inverses take.
    [[nodiscard]] std::size_t memory() const;

  private:
    struct Part {
        std::vector<std::size_t> nodes;
        Eigen::MatrixXd factor;  // of Cholesky, lower
    };

    std::vector<Part> parts_;
};

}  // namespace samara
