#pragma once

#include <cstddef>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace samara {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using Vector6d = Eigen::Matrix<double, 6, 1>;

/// Returns an index of a container as the signed index that Eigen takes.
constexpr Eigen::Index eigen_index(std::size_t index) noexcept {
    return static_cast<Eigen::Index>(index);
}

/// Returns the matrix of the cross product: skew(a) * b == a x b.
inline Matrix3d skew(const Vector3d& a) {
    Matrix3d matrix;
    matrix << 0.0, -a.z(), a.y(),  //
        a.z(), 0.0, -a.x(),        //
        -a.y(), a.x(), 0.0;
    return matrix;
}

/// The eigenvalues of a symmetric matrix in ascending order, and their unit eigenvectors as columns.
struct PrincipalValues {
    Vector3d values;      ///< ascending
    Matrix3d directions;  ///< column i is the unit eigenvector of values[i]
};

/// Returns the eigenvalues and eigenvectors of a symmetric matrix, of which the lower triangle alone is read.
/// Like the functions below it is compiled in linear_algebra.cpp alone: Eigen's solvers take seconds to
/// compile.
PrincipalValues principal_values(const Matrix3d& symmetric);
/// Returns the eigenvalues of a symmetric matrix in ascending order. The lower triangle alone is read.
Vector3d eigenvalues_of(const Matrix3d& symmetric);
Vector6d eigenvalues_of(const Matrix6d& symmetric);
/// Returns, in ascending order, the factors q for which symmetric x = q metric x has a solution x. `metric`
/// is positive definite.
Vector6d eigenvalues_of(const Matrix6d& symmetric, const Matrix6d& metric);

/// Returns the nearest positive semidefinite matrix: `symmetric` with its negative eigenvalues set to zero,
/// or `symmetric` itself where none is negative.
Matrix6d nearest_semidefinite(const Matrix6d& symmetric);

/// Returns the smallest rotation that takes the direction of `from` to that of `to`. Where these are opposite
/// its axis is any one across them.
Quaterniond rotation_between(const Vector3d& from, const Vector3d& to);

}  // namespace samara
