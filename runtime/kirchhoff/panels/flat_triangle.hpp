#pragma once

#include <array>
#include <vector>

#include "samara/core/surface/surface.hpp"

namespace samara {

/// A flat triangle with what its integrals need. Edge e runs from corner e to corner e + 1.
struct FlatTriangle {
    std::array<Vector3d, 3> corners;   ///< counter-clockwise from outside
    std::array<Vector3d, 3> tangents;  ///< unit, along the edges
    std::array<Vector3d, 3> outward;   ///< unit, in the plane, out of the triangle across the edges
    std::array<double, 3> lengths;     ///< of the edges
    Vector3d centroid;
    Vector3d normal;  ///< unit, outward
    double area;
    double radius;  ///< the distance from the centroid to the farthest corner
};

/// Returns the flat triangle with these corners. A triangle without an area gets a normal that is not finite.
FlatTriangle flat_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c);

/// Returns the triangles of a surface of order 1. Throws Error at a triangle without an area or a vertex that
/// is not finite.
std::vector<FlatTriangle> flat_triangles(const Surface& surface);

}  // namespace samara
