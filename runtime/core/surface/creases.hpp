#pragma once

#include <array>
#include <vector>

#include "samara/core/base/numbers.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// Faces that meet at more than this angle (radians) meet in a crease of the body; at less, they
/// stand for a curved surface. The angle at which `samara mesh` cuts surfaces too.
inline constexpr double sharp_angle = 40.0 * degree;

/// For each triangle, whether its side from corner i to the next is a crease.
using Creases = std::vector<std::array<bool, 3>>;

/// The least angle (radians) of a shallow crease, and how many times more than the edges beyond
/// the triangles on both its sides it turns.
inline constexpr double shallow_crease_angle = 5.0 * degree;
inline constexpr double shallow_crease_ratio = 3.0;

/// The sides at which the normals of the two triangles differ by more than sharp_angle, or by less where the
/// surface around turns so little that it must be a fold: shallow_crease_angle, shallow_crease_ratio. The
/// normals are those of the flat triangles for order 1, of the curved ones at the middle of the edge for
/// order 2.
/// Sides that are not shared by exactly two triangles count as creases.
Creases find_creases(const Surface& surface);

/// Whether any side is a crease.
bool any_crease(const Creases& creases);

/// Whether each vertex is the end of a crease.
std::vector<bool> vertices_on_creases(const Surface& surface, const Creases& creases);

}  // namespace samara
