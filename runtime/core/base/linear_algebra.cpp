#include "samara/core/base/linear_algebra.hpp"

#include <Eigen/Eigenvalues>

namespace samara {

PrincipalValues principal_values(const Matrix3d& symmetric) {
    const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(symmetric);
    return {solver.eigenvalues(), solver.eigenvectors()};
}

Vector3d eigenvalues_of(const Matrix3d& symmetric) {
    return principal_values(symmetric).values;
}

Vector6d eigenvalues_of(const Matrix6d& symmetric) {
    return Eigen::SelfAdjointEigenSolver<Matrix6d>(symmetric).eigenvalues();
}

Vector6d eigenvalues_of(const Matrix6d& symmetric, const Matrix6d& metric) {
    return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix6d>(symmetric, metric).eigenvalues();
}

Matrix6d nearest_semidefinite(const Matrix6d& symmetric) {
    const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(symmetric);
    if (solver.eigenvalues().minCoeff() >= 0.0) return symmetric;
    return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).asDiagonal() *
           solver.eigenvectors().transpose();
}

Quaterniond rotation_between(const Vector3d& from, const Vector3d& to) {
    return Quaterniond::FromTwoVectors(from, to);
}

}  // namespace samara
