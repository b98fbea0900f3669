#pragma once

#include <vector>

#include "samara/core/body/body.hpp"

namespace samara::test {

/// The sphere of radius 1 with 20 * 4^level triangles: an icosahedron whose edges are halved and pushed out.
Surface icosphere(int level);

/// The icosphere stretched to the semi-axes (m) and moved to the centre (m).
Surface ellipsoid(const Vector3d& semi_axes, int level, const Vector3d& centre = Vector3d::Zero());

/// The ellipsoid as an order-2 surface of 20 * 4^level triangles with all nodes on the ellipsoid.
Surface curved_ellipsoid(const Vector3d& semi_axes, int level);

/// The box with the edge lengths (m) about the origin, each face cut into 2 n^2 triangles.
Surface box(const Vector3d& edges, int n);

/// The surface after x -> map x + shift; a reflection also reverses the triangles, so that they stay outward.
Surface mapped(const Surface& surface, const Matrix3d& map, const Vector3d& shift = Vector3d::Zero());

/// The surfaces as one: a body of several closed parts.
Surface together(const std::vector<Surface>& parts);

/// The surface, about as large as the unit sphere, with a bump and a twist: an ellipsoid loses all symmetry.
Surface lopsided(Surface surface);

/// The icosphere with every vertex moved along the sphere by up to about `amount` edge lengths: an uneven
/// mesh.
Surface shaken_icosphere(int level, double amount, unsigned seed);

/// The moments of the flat corner triangles.
VolumeMoments moments_of(const Surface& surface);

/// Potentials that grow with the place along each axis, as an ellipsoid's do, but made up.
SurfaceLoads made_up_surface_loads(const Surface& surface, const VolumeMoments& moments);

/// A body with all parts filled: a small ellipsoid, its tensor and tables with values that are all different.
Body full_body();

/// Tables over the octahedral map with smooth values that agree where nodes coincide.
LoadTables smooth_tables(int subdivisions);

}  // namespace samara::test
