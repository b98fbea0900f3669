#pragma once

#include <string>

#include "samara/body/surface.hpp"

namespace samara {

/// Points nearer than this part of the bounding box's diagonal are one vertex.
inline constexpr double welding_tolerance = 1e-6;

/// The surface with vertices that lie within `welding_tolerance` of each other made one, and those that no
/// triangle uses left out; triangles keep their number and order. Throws Error, named with `label`, where a
/// coordinate is not finite, an index is out of range, or there are no triangles.
Surface welded(const Surface& surface, const std::string& label);

/// Checks that the welded surface bounds a body, and throws an Error of one line, "LABEL: what is wrong,
/// where, and the remedy", at the first fault: faces without area, faces given twice, stray faces, edges of
/// three or more faces, corners where separate sheets touch, holes, edge nodes that two triangles of order 2
/// do not share, curved faces that turn over, faces turned round, a surface that is inside out, a body within
/// a body, an enclosed volume of zero, faces that cross. Faces are numbered from 1 in the order of the file,
/// places are in the units of the file. Cavities are sound: closed pieces within the body that look into the
/// cavity.
void require_sound_surface(const Surface& surface, const std::string& label);

/// The point, "(x, y, z)" in four digits, as errors name it.
std::string place(const Vector3d& point);

}  // namespace samara
