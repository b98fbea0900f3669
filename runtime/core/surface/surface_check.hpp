#pragma once

#include <string>

#include "samara/core/surface/surface.hpp"

namespace samara {

/// Checks that the welded surface bounds a body, and throws an Error of one line, "what is wrong, where; the
/// remedy", at the first error: faces without area, faces given twice, stray faces, edges of three or more
/// faces, corners where separate sheets touch, holes, edge nodes that two triangles of order 2 do not share,
/// curved faces that overturn, faces of reversed orientation, a surface that is inside out, a body within a
/// body, a cavity, an enclosed volume of zero. Faces are numbered from 1 in their order, places are in the
/// units of the vertices. Whether faces cross is not checked.
void require_bounding_surface(const Surface& surface);

/// Checks a surface that may have a boundary, and throws an Error as require_bounding_surface() does: a
/// closed one is checked as a body's is; a sheet for faces without area, faces given twice, edges of three or
/// more faces, and faces of reversed orientation.
void require_solid_surface(const Surface& surface);

/// Returns the point as "(x, y, z)" in four digits, as errors name it.
std::string place(const Vector3d& point);

}  // namespace samara
