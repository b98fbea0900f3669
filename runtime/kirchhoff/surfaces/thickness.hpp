#pragma once

#include "samara/core/surface/surface.hpp"

namespace samara {

/// Returns the thickness of a body relative to its triangles: the distance from a triangle's centroid
/// straight into the body to the other side, over the triangle's longest edge; the value that a fifth of the
/// surface's area lies below. Measured on the flat corner triangles, from up to 200 of them.
double relative_thickness(const Surface& surface);

}  // namespace samara
