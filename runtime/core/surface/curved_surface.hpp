#pragma once

#include "samara/core/surface/surface.hpp"

namespace samara {

/// Returns the point (m) of the triangle with corner coordinates (1 - u - v, u, v): on the flat triangle for
/// order 1, on the quadratic one for order 2.
Vector3d point_of_triangle(const Surface& surface, std::size_t triangle, double u, double v);

/// Returns the outward normal (m^2, not of unit length) of the triangle at corner coordinates (1 - u - v, u,
/// v): the cross product of the derivatives of its point by u and v.
Vector3d normal_of_triangle(const Surface& surface, std::size_t triangle, double u, double v);

/// Returns the volume (m^3) that the triangles enclose, each curved one as four flat ones; negative where
/// they are inside out.
double enclosed_volume(const Surface& surface);

/// Returns flat triangles that follow the curved ones: each is cut into subdivisions^2, with three vertices
/// of its own. A surface of order 1 is returned as it is.
Surface flattened(const Surface& surface, int subdivisions);

/// Returns the surface as flat triangles on its own vertices and edge nodes: each triangle of order 2 becomes
/// four.
Surface flattened_surface(const Surface& surface);

/// Returns the surface's corners as a surface of order 2, with nodes halfway along straight edges.
Surface with_straight_edge_nodes(const Surface& surface);

/// Returns the flat surface of the corners alone, unused vertices left out.
Surface without_edge_nodes(const Surface& surface);

/// Returns whether all nodes of a surface of order 2 lie halfway along straight edges, within 1e-6 of their
/// length.
bool has_straight_edges(const Surface& surface);

/// Returns the triangles whose curved face overturns somewhere (its normal is more than a right angle from
/// that of its corners): the surface of order 2 is too coarse for its curvature there.
std::vector<std::int32_t> overturned_triangles(const Surface& surface);

/// Makes the edges of overturned triangles straight.
void straighten_overturned(Surface& surface);

}  // namespace samara
