#pragma once

#include "samara/core/body/body.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// Computes volume, centroid, second moments and surface area of the body inside the closed surface by the
/// divergence theorem. They are exact but for rounding, for flat triangles and for the quadratic triangles of
/// a surface of order 2; only the area of quadratic triangles is by quadrature (25 points, degree 9 in the
/// corner coordinates). The volume is negative for a surface that is inside out. Throws nothing: for a volume
/// of zero the centroid is that of the vertices and the second moments are zero.
VolumeMoments volume_moments(const Surface& surface);

}  // namespace samara
