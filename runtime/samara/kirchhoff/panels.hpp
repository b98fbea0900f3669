#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "samara/body/surface.hpp"

namespace samara {

/// A flat triangle that carries one unknown.
struct Panel {
    std::array<std::int32_t, 3> corners;  ///< rows of Panels::vertices, counter-clockwise from outside
    Vector3d centroid;
    Vector3d normal;  ///< unit, outward
    double area;
    double radius;           ///< the distance from the centroid to the farthest corner
    Matrix3d second_moment;  ///< mean of (y - centroid)(y - centroid)^T over the panel
};

/// A surface as the boundary elements see it: flat triangles, about the reference point and scaled to the
/// unit size, so that bodies of all sizes and places round alike.
struct Panels {
    std::vector<Vector3d> vertices;
    std::vector<Panel> panels;
    double length = 1.0;  ///< m, what one unit is
};

/// The panels of a surface's corner triangles about `reference_point` (m, shape axes), in units of `length`
/// (m). Throws Error at a triangle without an area or a vertex that is not finite.
Panels make_panels(const Surface& surface, const Vector3d& reference_point, double length);

/// A surface of order 1 in which each triangle is four: the middle nodes of its edges are those of an order-2
/// surface, or the midpoints of the straight edges.
Surface subdivided(const Surface& surface);

}  // namespace samara
