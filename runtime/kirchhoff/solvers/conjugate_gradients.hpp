#pragma once

#include <functional>
#include <optional>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/kirchhoff/panels/linear_elements.hpp"

namespace samara {

/// What the solution of A X = B is wanted for.
struct SolutionEnergies {
    Matrix6d energies = Matrix6d::Zero();  ///< B^T A^-1 B
    int iterations = 0;
};

/// B^T A^-1 B for a symmetric positive semidefinite A and six columns B in its range, by conjugate gradients
/// with a preconditioner, all columns at once (Hestenes and Stiefel 1952). The energies come from the
/// variational form X^T B + B^T X - X^T A X, whose error is of second order in that of X.
///
/// `scales`: what is added to the energies' diagonal later. A column ends where the energy that is left (its
/// preconditioned residual) is below `tolerance` times energy plus scale, or below a thousandth of that of
/// the largest of its three columns (omega or v). Nothing where the matrix turns out not to be positive, or
/// 300 iterations do not suffice. `progress` is called with the share of the digits done.
std::optional<SolutionEnergies> conjugate_gradients(
    const std::function<SixColumns(const SixColumns&)>& multiply,
    const std::function<SixColumns(const SixColumns&)>& precondition, const SixColumns& right_hand_sides,
    const Vector6d& scales, double tolerance, const std::function<void(double)>& progress = {});

}  // namespace samara
