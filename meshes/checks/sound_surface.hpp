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

/// The overlap of two flat triangles that lie on each other.
struct FlushPatch {
    double area = 0.0;                   ///< m^2
    Vector3d middle = Vector3d::Zero();  ///< m
};

/// Returns the part of `b` that covers `a` along the normal of `a`, where all of it lies within `tolerance`
/// (m) of the plane of `a` and far nearer to it than it is wide; nothing where its area is less than a
/// millionth of that of the smaller triangle. Both triangles must have an area.
std::optional<FlushPatch> flush_patch(const std::array<Vector3d, 3>& a, const std::array<Vector3d, 3>& b,
                                      double tolerance);

/// Joins the closed parts of a welded surface that overlap or touch: they are replaced by the boundary of
/// their union, computed with exact arithmetic (CGAL) and welded again. A gap narrower than the welding
/// tolerance between sides that lie on each other is closed. Parts that are not closed or face inwards, parts
/// that touch nothing, and surfaces of order 2 are returned unchanged. Throws Error, which names the parts
/// and their places, where the union is no sound surface, for example where parts touch in an edge alone.
Surface with_parts_joined(const Surface& surface);

}  // namespace samara
