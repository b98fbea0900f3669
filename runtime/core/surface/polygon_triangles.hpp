#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// Cuts a polygon, flat or nearly so, convex or not, into triangles of its orientation. `corners`: three or
/// more indices into `vertices`. Ears are cut off all around before any is cut where one was, so that no
/// corner gets long rows of slivers. The time grows with the corners times the reflex ones among them. Of a
/// polygon that crosses itself the rest is cut as a fan. D. Eberly, Triangulation by Ear Clipping, 2008.
std::vector<std::array<std::int32_t, 3>> polygon_triangles(const std::vector<Vector3d>& vertices,
                                                           const std::vector<std::int32_t>& corners);

}  // namespace samara
