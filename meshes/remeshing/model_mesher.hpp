#pragma once

#include <string>
#include <vector>

#include "meshes/mesh_options.hpp"
#include "meshes/remeshing/mesh_size_field.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

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
