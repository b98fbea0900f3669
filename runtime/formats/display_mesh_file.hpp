#pragma once

#include <filesystem>

#include "samara/core/surface/display_mesh.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// The mesh of an .obj or .glb file with its texture coordinates, normals and material slots, in the file's
/// axes; those of .glb, y up, are turned so that z is up. Throws Error, which names the file and the place,
/// where it holds no triangles or is neither.
DisplayMesh read_display_mesh_file(const std::filesystem::path& file);

/// Its triangles alone.
Surface surface_of(const DisplayMesh& display);

}  // namespace samara
