#pragma once

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// Eigenvalues in ascending order, and their unit eigenvectors as columns.
struct PrincipalValues {
    Vector3d values;
    Matrix3d directions;
};

/// Of symmetric matrices, whose lower triangle alone is read. They stand here because Eigen's solvers take
/// seconds to compile wherever they are used.
PrincipalValues principal_values(const Matrix3d& symmetric);
/// The eigenvalues alone, in ascending order.
Vector3d eigenvalues_of(const Matrix3d& symmetric);
Vector6d eigenvalues_of(const Matrix6d& symmetric);
/// The factors q, ascending, for which symmetric x = q metric x has a solution x; `metric` is positive
/// definite.
Vector6d eigenvalues_of(const Matrix6d& symmetric, const Matrix6d& metric);

/// The nearest that is positive semidefinite: the same with its negative eigenvalues made zero, and untouched
/// where it has none.
Matrix6d nearest_semidefinite(const Matrix6d& symmetric);

}  // namespace samara
