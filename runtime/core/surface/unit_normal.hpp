#pragma once

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// The direction of a normal as a file gives it, of length one: of any length but zero, also where its square
/// under- or overflows. What has no direction (zero, infinite) gets z.
inline Vector3d unit_normal(const Vector3d& given) {
    const double largest = given.cwiseAbs().maxCoeff();
    if (!(largest > 0.0) || !given.allFinite()) return Vector3d::UnitZ();
    return (given / largest).normalized();
}

}  // namespace samara
