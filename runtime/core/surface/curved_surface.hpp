#pragma once

#include "samara/core/surface/surface.hpp"

namespace samara {

/// The point (m) of the triangle with corner coordinates (1 - u - v, u, v): on the flat triangle for order 1,
/// on the quadratic one for order 2.
Vector3d point_of_triangle(const Surface& surface, std::size_t triangle, double u, double v);

/// The outward normal (m^2, not unit) of the triangle at corner coordinates (1 - u - v, u, v): the cross
/// product of the derivatives of its point by u and v.
Vector3d normal_of_triangle(const Surface& surface, std::size_t triangle, double u, double v);

/// The volume (m^3) under the triangles, the curved ones as four flat ones each; negative where they are
/// inside out.
double enclosed_volume(const Surface& surface);

/// Flat triangles that follow the curved ones: each is cut into subdivisions^2, with three vertices of its
/// own. A surface of order 1 is returned as it is.
Surface flattened(const Surface& surface, int subdivisions);

/// The surface of order 1 as one of order 2, with nodes halfway along its straight edges. Of a surface of
/// order 2, its corners.
Surface with_straight_edge_nodes(const Surface& surface);

/// The flat surface of the corners alone, unused vertices left out.
Surface without_edge_nodes(const Surface& surface);

/// Whether all nodes of a surface of order 2 lie halfway along straight edges, within 1e-6 of their length.
bool has_straight_edges(const Surface& surface);

/// The triangles whose curved face turns over somewhere (its normal leans more than a right angle from that
/// of its corners): such a surface of order 2 is too coarse for its curvature.
std::vector<std::int32_t> overturned_triangles(const Surface& surface);

/// Makes the edges of overturned triangles straight.
void straighten_overturned(Surface& surface);

}  // namespace samara
