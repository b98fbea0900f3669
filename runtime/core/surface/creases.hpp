#pragma once

#include <array>
#include <vector>

#include "samara/core/base/numbers.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// The angle (rad) between the normals of two faces from which their edge is a crease of the body; below it
/// they stand for a curved surface. `samara mesh` cuts surfaces at the same angle.
inline constexpr double sharp_angle = 40.0 * degree;

/// Tells for each triangle whether its side from corner i to the next is a crease.
using Creases = std::vector<std::array<bool, 3>>;

/// The least angle (rad) of a shallow crease, and its least ratio to the angles at the edges beyond the
/// triangles on both its sides.
inline constexpr double shallow_crease_angle = 5.0 * degree;
inline constexpr double shallow_crease_ratio = 3.0;

/// Returns the sides at which the normals of the two triangles differ by more than sharp_angle, or by less
/// where the surface around is so flat that the side must be a fold (shallow_crease_angle,
/// shallow_crease_ratio). The normals are those of the flat triangles for order 1, of the curved ones at the
/// middle of the edge for order 2. Sides that are not shared by exactly two triangles count as creases.
Creases find_creases(const Surface& surface);

/// Returns whether any side is a crease.
bool any_crease(const Creases& creases);

/// Returns for each vertex whether a crease ends there.
std::vector<bool> vertices_on_creases(const Surface& surface, const Creases& creases);

}  // namespace samara
