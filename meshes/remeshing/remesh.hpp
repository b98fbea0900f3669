#pragma once

#include <functional>
#include <string>

#include "meshes/mesh_options.hpp"
#include "samara/body/surface.hpp"

namespace samara {

/// Covers the welded and sound surface of triangles with new ones, sized as in mesh_geometry: where there are
/// many more than needed they are reduced first (reduced), then evened (evened) on the smooth shape that the
/// given triangles stand for (SmoothShape), with faces that meet at more than 40 degrees as edges, or 10
/// where that would change the volume by more than 3 %. `surface` and the result are in metres: options.scale
/// is not used. Throws Error, which proposes to keep the triangles, where the new surface passes through
/// itself or its volume differs by more than 15 %. `progress`: called with the share of the work done, 0
/// to 1.
Surface remesh(const Surface& surface, const MeshOptions& options, const std::string& label,
               const std::function<void(double)>& progress = {});

}  // namespace samara
