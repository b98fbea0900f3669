#pragma once

#include <Eigen/Geometry>

#include "samara/core/surface/surface.hpp"

namespace samara {

/// The distance within which points are one vertex, relative to the bounding box's diagonal.
inline constexpr double welding_tolerance = 1e-6;

/// Throws Error, without a file name, where there are no triangles, an index is out of range, or a coordinate
/// is not finite or beyond the size of any body.
void require_usable_numbers(const Surface& surface);

/// Returns the surface with vertices that lie within `part` of the bounding box's diagonal of each other
/// merged, and those that no triangle uses left out; triangles keep their number and order. Throws Error as
/// require_usable_numbers() does, where the surface is smaller than any body, and where it lies so far from
/// the origin that its numbers do not resolve its points.
Surface welded(const Surface& surface, double part = welding_tolerance);

/// Returns the box around the triangles' corners (m).
Eigen::AlignedBox3d bounding_box(const Surface& surface);

}  // namespace samara
