#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// The most patches that a surface can be divided into.
inline constexpr int most_surface_patches = 32;

/// A triangle of a patch: one of the surface's, or a part of one.
struct PatchFace {
    std::array<Vector3d, 3> corners;
    std::size_t triangle = 0;  ///< of the surface
};

/// A part of a surface on which loads act at its own velocity.
struct SurfacePatch {
    Vector3d place = Vector3d::Zero();  ///< m: its centre of area, from that of the whole surface
    double share = 1.0;                 ///< its part of the whole area
    std::vector<PatchFace> faces;
};

/// Divides a surface into compact patches: the piece with the widest spread is cut through its centre of
/// area, across the direction in which it is widest, until there are so many. The shares add up to one and
/// the places, weighed by them, to zero. A cut goes through triangles, so that the mesh does not matter;
/// where a piece is as wide in several directions, which of them is cut first is chance. `count`: 1 to
/// most_surface_patches.
std::vector<SurfacePatch> surface_patches(const Surface& surface, int count);

}  // namespace samara
