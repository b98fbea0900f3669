#pragma once

#include <string>

#include "samara/core/body/body.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// Images of a body's surface that differ by less than this part of the body's size, its greatest distance
/// from the centroid, count as the same.
inline constexpr double default_symmetry_tolerance = 0.01;

/// The rotations and reflections about the centroid that map the body's shape onto itself, whatever its
/// triangles, within `tolerance` (of the body's size; more where the triangles are coarse: the figure used is
/// in the result).
///
/// Candidates come from the shape's axes, from the eigenvectors of the second moments, and where eigenvalues
/// coincide from a search over the axes left free: rotations of order up to 16 about a single axis, and the
/// groups of the tetrahedron, the cube and the icosahedron. Each is verified on the surface. Elements that
/// permute the shape's axes are exactly signed permutations; in `axes` the others are as far as that frame
/// allows. For kind axial, `elements` holds the identity, the mirror through the axis and, where the body has
/// it, the mirror across the axis and the half turn that both make; for kind spherical the identity and the
/// inversion.
Symmetry find_symmetry(const Surface& surface, const VolumeMoments& moments,
                       double tolerance = default_symmetry_tolerance);

/// The symmetry in words, such as "8 rotations and reflections, 3 mirror planes".
std::string describe(const Symmetry& symmetry);

}  // namespace samara
