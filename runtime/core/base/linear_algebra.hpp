#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace samara {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// The matrix of the cross product: skew(a) * b == a x b.
inline Matrix3d skew(const Vector3d& a) {
    Matrix3d matrix;
    matrix << 0.0, -a.z(), a.y(),  //
        a.z(), 0.0, -a.x(),        //
        -a.y(), a.x(), 0.0;
    return matrix;
}

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

/// The least turn that takes the direction of `from` to that of `to`, about any axis across them where they
/// are opposite. Here because Eigen's takes seconds to compile wherever it is used.
Quaterniond turn_between(const Vector3d& from, const Vector3d& to);

}  // namespace samara
