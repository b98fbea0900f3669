#pragma once

#include <filesystem>
#include <functional>

#include "meshes/mesh_options.hpp"
#include "meshes/remeshing/remesh.hpp"

namespace samara {

/// Meshes the body in a file of exact geometry (.geo, .step, .stp, .brep): the surface of its volumes, or all
/// of its surfaces where it has no volume. Faces that two volumes share are left out. Where the count of
/// triangles is given, it is met within about 5 %, unless the geometry's own edges and corners need more. The
/// result is in metres, welded, checked (require_sound_surface) and oriented outwards; the nodes of order 2
/// lie on the geometry. The mesh is held against a finer one of order 2: where it misses the shape (miss_of),
/// options that allow it give it up to 16 times the triangles, and what still misses it is an Error. STEP
/// files state their unit, which is honoured. Throws Error. `progress`: called with the share of the work
/// done, 0 to 1.
MeshedShape mesh_geometry(const std::filesystem::path& file, const MeshOptions& options,
                          const std::function<void(double)>& progress = {});

}  // namespace samara
