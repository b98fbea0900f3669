#pragma once

#include <algorithm>
#include <vector>

#include "samara/core/body/body.hpp"

namespace samara::test {

/// The finite group that the matrices generate, with the shape axes as map axes.
inline Symmetry generated_by(const std::vector<Matrix3d>& generators) {
    Symmetry symmetry;
    std::vector<Matrix3d>& elements = symmetry.elements;
    for (std::size_t i = 0; i < elements.size(); ++i) {
        for (const Matrix3d& generator : generators) {
            const Matrix3d product = generator * elements[i];
            const bool known = std::any_of(elements.begin(), elements.end(), [&](const Matrix3d& element) {
                return (element - product).norm() < 1e-9;
            });
            if (!known) elements.push_back(product);
        }
    }
    return symmetry;
}

inline Matrix3d quarter_turn(const Vector3d& axis) {
    return (axis * axis.transpose() + skew(axis)).eval();
}

/// Mirrors across the three coordinate planes: 8 elements.
inline Symmetry box_symmetry() {
    return generated_by(
        {Vector3d(-1, 1, 1).asDiagonal(), Vector3d(1, -1, 1).asDiagonal(), Vector3d(1, 1, -1).asDiagonal()});
}

/// A square prism along z: 16 elements.
inline Symmetry square_prism_symmetry() {
    return generated_by(
        {quarter_turn(Vector3d::UnitZ()), Vector3d(-1, 1, 1).asDiagonal(), Vector3d(1, 1, -1).asDiagonal()});
}

/// 48 elements.
inline Symmetry cube_symmetry() {
    return generated_by(
        {quarter_turn(Vector3d::UnitZ()), quarter_turn(Vector3d::UnitX()), Vector3d(-1, 1, 1).asDiagonal()});
}

/// A rotation that is aligned with nothing.
inline Matrix3d some_rotation() {
    return Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
}

/// Returns the symmetry of the body in a shape file in whose axes it is rotated by `rotation`.
inline Symmetry turned(Symmetry symmetry, const Matrix3d& rotation) {
    symmetry.axes = rotation * symmetry.axes;
    symmetry.axis = rotation * symmetry.axis;
    for (Matrix3d& element : symmetry.elements) element = rotation * element * rotation.transpose();
    return symmetry;
}

}  // namespace samara::test
