#pragma once

#include <string>

#include "samara/core/body/body.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// Images of a body's surface that differ by less count as equal; relative to the body's size, its greatest
/// distance from the centroid.
inline constexpr double default_symmetry_tolerance = 0.01;

/// Finds the rotations and reflections about the centroid that map the body's shape onto itself, whatever its
/// triangles, within `tolerance` (relative to the body's size; more where the triangles are coarse: the
/// result holds the value used).
///
/// Candidates come from the shape's axes, from the eigenvectors of the second moments, and where eigenvalues
/// coincide from a search over the axes left free: rotations of order up to 16 about a single axis, and the
/// groups of the tetrahedron, the cube and the icosahedron. Each is verified on the surface. Elements that
/// permute the shape's axes are exactly signed permutations; in `axes` the others are as far as that frame
/// allows. For the type axial, `elements` holds the identity, the mirror through the axis and, where the body
/// has it, the mirror perpendicular to the axis and the product of both; for the type spherical the identity
/// and the inversion.
Symmetry find_symmetry(const Surface& surface, const VolumeMoments& moments,
                       double tolerance = default_symmetry_tolerance);

/// Describes the symmetry in words, such as "8 rotations and reflections, 3 mirror planes".
std::string describe(const Symmetry& symmetry);

}  // namespace samara
