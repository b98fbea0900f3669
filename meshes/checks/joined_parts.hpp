#pragma once

#include "samara/core/surface/surface.hpp"

namespace samara {

/// The welded surface with those of its closed parts that overlap or touch made one: the boundary of their
/// union, with exact arithmetic (CGAL), welded again. A gap narrower than the welding tolerance between sides
/// that lie on each other is closed. What is no closed surface that looks outwards, what nothing touches, and
/// surfaces of order 2 stay as they are. Throws Error, which names the parts and the places, where the union
/// is no sound surface, as that of parts which touch in an edge alone.
Surface with_parts_joined(const Surface& surface);

}  // namespace samara
