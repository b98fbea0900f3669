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

}  // namespace samara
