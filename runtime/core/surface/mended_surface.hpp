#pragma once

#include "samara/core/surface/surface.hpp"
#include "samara/core/surface/welded_surface.hpp"

namespace samara {

/// Returns the surface welded, within `part` of its bounding box's diagonal, and mended where that needs no
/// choice. Triangles with two equal corners are left out. A flat triangle with an open side on which corners
/// of other open sides lie is cut there, since what looks like a hole is none. Where a corner of a flat
/// triangle lies on its longest side, and its other sides have neighbours, the triangle and its neighbour
/// across that side get another common side, so that both have area. All use the same tolerance; the other
/// triangles keep their order, not their numbers. Throws Error as welded() does, and where no triangle is
/// left.
Surface mended(const Surface& surface, double part = welding_tolerance);

}  // namespace samara
