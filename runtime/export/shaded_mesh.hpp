#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "samara/core/surface/surface.hpp"

namespace samara {

/// A triangle mesh for display: one normal for each vertex, so that vertices are doubled along creases.
struct ShadedMesh {
    std::vector<Vector3d> positions;                      ///< m, shape axes
    std::vector<Vector3d> normals;                        ///< outward unit vectors, one for each position
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise seen from outside
};

/// Returns the surface with normals that are smooth over its curved parts and sharp at its creases: a
/// corner's normal is the mean, weighted by the corner's angle, of those triangles about its vertex whose
/// faces are within `sharp_angle` (rad) of its own. Order 2 is flattened first; triangles without area are
/// left out. The result is the same for the same surface.
ShadedMesh shaded_mesh(const Surface& surface, double sharp_angle = 0.9);

}  // namespace samara
