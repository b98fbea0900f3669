#pragma once

#include <string>

#include "samara/body/surface.hpp"

namespace samara {

/// The surface with vertices at the same place made one, unused ones left out. Edge nodes of order 2 too.
Surface with_merged_vertices(const Surface& surface);

/// In words, what is wrong with a surface that is not closed, outward and free of repeated triangles; empty
/// where its edges show no fault. Vertices at the same place must be one.
std::string edge_fault(const Surface& surface);

/// In words, what keeps closed components from being bodies in one fluid: one that is inside out, or lies
/// within another; empty where there is no such fault. `surface` must have no edge fault.
std::string component_fault(const Surface& surface);

/// with_merged_vertices(surface), where it is a body that can be solved for. Throws Error, without a file
/// name, at any fault above, at triangles without an area and at vertices that are not finite.
Surface sound_surface(const Surface& surface);

}  // namespace samara
