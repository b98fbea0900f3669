#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "meshes/mesh_options.hpp"
#include "meshes/remeshing/mesh_size_field.hpp"
#include "meshes/remeshing/remesh.hpp"
#include "samara/core/surface/surface.hpp"

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

/// Options of the current GmshSession that meshing anew starts from, whatever a .geo file has set.
void forget_sizes_of_file();

/// gmsh's mesh of the surfaces with the given tags (all, where none are given), made anew: welded, turned
/// outwards, of order 1.
Surface generated(const std::string& label, const std::vector<int>& tags);

/// The mesh that gmsh holds, as `generated` gives it, or of order 2 with nodes on the geometry.
Surface mesh_held(const std::string& label, const std::vector<int>& tags, int order);

/// Has gmsh mesh the current model with sizes by the field: `size` (in units of the model) where they are
/// largest, or, with Sizing::triangles, as it takes for about options.triangles triangles; `size` is not used
/// then. gmsh holds the mesh afterwards.
void mesh_model(const MeshSizeField& field, const MeshOptions& options, double size,
                const std::vector<int>& tags);

}  // namespace samara
