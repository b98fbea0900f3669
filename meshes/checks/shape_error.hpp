#pragma once

#include "samara/core/body/body.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// Compares `mesh` with `shape`: the distances of some thousand points of each from the other, and the
/// relative differences of volume and area. Both are closed and welded, of order 1 or 2. The member
/// `faceting` is left at 0.
ShapeError shape_error(const Surface& shape, const Surface& mesh);

/// The difference between facets and the smooth shape through their vertices.
struct Smoothing {
    double volume = 0.0;   ///< relative change of the volume from the facets to the smooth shape
    double between = 0.0;  ///< volume between the two, counted positive everywhere, relative to that of the
                           ///< body; at most 1
};

/// Estimates the smoothing of a closed and welded surface of order 1: at each edge at which the normals of
/// the two facets differ by less than the crease angle, the smooth shape is taken for the arc of a circle
/// over the narrower facet.
Smoothing smoothing_of(const Surface& flat);

/// Returns the largest error of a mesh relative to what is allowed: 0.5 % of the volume, 0.5 % of the
/// diagonal of the shape's bounding box as distance, and 2 % of the area. `smoothing`: the relative change of
/// volume and area up to which the mesh may have rounded facets off.
double miss_of(const ShapeError& error, double smoothing = 0.0);

/// Computes volume, centroid, second moments and surface area of the body inside the closed surface by the
/// divergence theorem. They are exact but for rounding, for flat triangles and for the quadratic triangles of
/// a surface of order 2; only the area of quadratic triangles is by quadrature (25 points, degree 9 in the
/// corner coordinates). The volume is negative for a surface that is inside out. Throws nothing: for a volume
/// of zero the centroid is that of the vertices and the second moments are zero.
VolumeMoments volume_moments(const Surface& surface);

}  // namespace samara
