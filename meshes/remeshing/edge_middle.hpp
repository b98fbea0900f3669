#pragma once

#include <array>
#include <functional>
#include <optional>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// The point of a smooth surface over a point near it (m); nothing where there is none.
using LiftedPoint = std::function<std::optional<Vector3d>(const Vector3d&)>;

/// Where the middle node of an edge of quadratic triangles goes on the smooth surface that they follow: where
/// the surface's normal is across the chord, and between the normals at its ends. To the fourth order in the
/// edge's length the triangles follow the surface with it, to the third with the point nearest to the chord's
/// middle (docs/speed-against-error/kirchhoff.md). `ends`: on the surface; `across`: the third corners of the
/// triangles on both sides. Nothing where the surface is not known all around.
std::optional<Vector3d> middle_on_surface(const std::array<Vector3d, 2>& ends,
                                          const std::array<Vector3d, 2>& across, const LiftedPoint& lifted);

}  // namespace samara
