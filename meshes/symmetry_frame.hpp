#pragma once

#include <vector>

#include "samara/base/linear_algebra.hpp"

namespace samara {

/// A right-handed frame (columns) in which as many of the group's elements as can be are signed permutations
/// of the axes: aligned with mirrors and rotation axes. Of the equally good ones the identity, or else the
/// one turned and relabelled nearest to it.
Matrix3d aligned_frame(const std::vector<Matrix3d>& elements);

/// A right-handed frame with the unit vector `axis`, or its opposite, as the column where it is largest,
/// turned as little as may be from the identity.
Matrix3d frame_about(const Vector3d& axis);

/// The group's elements with those that are signed permutations in `frame`, but for the tolerance, made
/// exactly so.
std::vector<Matrix3d> snapped_in_frame(const std::vector<Matrix3d>& elements, const Matrix3d& frame);

}  // namespace samara
