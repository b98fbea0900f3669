#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// A closed, outward-oriented triangle surface, in metres, in the axes of the shape file.
///
/// Corners come first in every triangle: `corners[t]` are three indices into `vertices`, counter-clockwise
/// seen from outside. A surface of order 2 also has the middle node of each edge, `edge_nodes[t]`: nodes
/// between the corners (0,1), (1,2) and (2,0). For order 1 `edge_nodes` is empty.
struct Surface {
    std::vector<Vector3d> vertices;                       ///< m
    std::vector<std::array<std::int32_t, 3>> corners;     ///< of each triangle, anticlockwise from outside
    std::vector<std::array<std::int32_t, 3>> edge_nodes;  ///< middles of edges, where order is 2

    /// Returns 1 where triangles are flat, 2 where they are curved.
    [[nodiscard]] int order() const { return edge_nodes.empty() ? 1 : 2; }
    /// Returns the number of triangles.
    [[nodiscard]] std::size_t triangle_count() const { return corners.size(); }
};

/// Returns a vertex (m) by an index that the surface stores.
inline const Vector3d& vertex(const Surface& surface, std::int32_t index) {
    return surface.vertices[static_cast<std::size_t>(index)];
}

/// Returns half the cross product of two edges: its length is the flat triangle's area (m^2), its direction
/// the outward normal.
Vector3d area_vector(const Surface& surface, std::size_t triangle);

/// Returns the centroid of the flat triangle's corners (m).
Vector3d triangle_centroid(const Surface& surface, std::size_t triangle);

/// Returns the length (m) of the flat triangle's longest edge.
double longest_edge(const Surface& surface, std::size_t triangle);

/// Returns the sum of the flat triangles' areas (m^2).
double surface_area(const Surface& surface);

/// Returns the point of the triangle abc (m) that is nearest to p. Ericson, Real-Time Collision Detection
/// (2005), 5.1.5.
Vector3d closest_point_of_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                                   const Vector3d& c) noexcept;

/// Returns the projected area (m^2) of a convex body along the unit vector `direction`; for other bodies an
/// upper bound, the sum over the faces towards it.
double projected_area(const Surface& surface, const Vector3d& direction);

/// Returns L = sqrt(S / pi) (m), the diameter of the sphere with the surface area S (m^2): the length scale
/// of all tables.
double reference_length(double surface_area);

}  // namespace samara
