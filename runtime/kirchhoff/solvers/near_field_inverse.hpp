#pragma once

#include <Eigen/SparseLU>

#include "samara/kirchhoff/operators/curved_equations.hpp"

namespace samara {

/// The inverse of the strong entries of the matrix alone, to precondition with: it takes up the pairs of
/// panels that face each other across a thin body, which a solver without it is slow on.
class NearFieldInverse {
  public:
    /// Of the diagonal and of the entries above `least_entry`.
    NearFieldInverse(const CurvedEquations& equations, double least_entry);

    /// The inverse times six columns; the columns themselves where the strong entries have no inverse.
    [[nodiscard]] SixColumns operator*(const SixColumns& columns) const;

  private:
    Eigen::SparseLU<Eigen::SparseMatrix<double>> factors_;
};

}  // namespace samara
