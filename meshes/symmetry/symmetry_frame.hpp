#pragma once

#include <vector>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// A right-handed frame with the unit vector `axis`, or its opposite, as the column where it is largest,
/// turned as little as may be from the identity.
Matrix3d frame_about(const Vector3d& axis);

/// A finite group of rotations and reflections, and a frame for it.
struct AlignedGroup {
    /// Columns, right-handed: aligned with mirrors and rotation axes so that as many elements as can be are
    /// signed permutations of them; of the equally good frames the one turned and relabelled nearest to the
    /// identity.
    Matrix3d axes = Matrix3d::Identity();
    /// The identity first. Products of elements are elements but for rounding.
    std::vector<Matrix3d> elements;
};

/// The group that the elements, found within a tolerance, stand for: they are replaced by the mean of the
/// quotients that each is until all of these agree (Grove, Karcher and Ruh, Math. Ann. 211, 1974). Where the
/// elements that permute `axes` are given as exactly signed permutations, the whole group is turned into the
/// shape's axes: `axes` is the identity and these elements stay exact.
AlignedGroup aligned_group(const std::vector<Matrix3d>& elements);

}  // namespace samara
