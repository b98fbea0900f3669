#pragma once

#include <array>
#include <optional>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// Checks that the welded surface is a body's: as require_bounding_surface (core/surface/surface_check.hpp)
/// does, and that no faces cross or lie on each other. Throws Error of one line, without a file name. Takes n
/// log n time.
void require_sound_surface(const Surface& surface);

/// Where two flat triangles lie on each other.
struct FlushPatch {
    double area = 0.0;
    Vector3d middle = Vector3d::Zero();
};

/// The part of `b` that lies on `a` or under it, seen along the normal of `a`, where all of it is within
/// `tolerance` (m) of the plane of `a` and far nearer than it is wide; none where it is less than a millionth
/// of the smaller triangle. Neither triangle may be without area.
std::optional<FlushPatch> flush_patch(const std::array<Vector3d, 3>& a, const std::array<Vector3d, 3>& b,
                                      double tolerance);

}  // namespace samara
