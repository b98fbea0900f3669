#pragma once

#include <cstddef>
#include <filesystem>

#include "samara/core/surface/display_mesh.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// The most corners of one face of an OBJ file: the time to cut it may grow with their square.
inline constexpr std::size_t most_obj_corners = 10'000;

/// The triangles of a Wavefront OBJ file: its vertices and faces, all else is left out; polygons are cut into
/// triangles (polygon_triangles). Throws Error, which names the line, where a vertex or face is none.
Surface read_obj_file(const std::filesystem::path& file);

/// The same with texture coordinates, normals (where all corners have one) and the materials that its faces
/// use, in the order of their use; their colours are those of the .mtl files that it names, where these lie
/// there. Throws Error besides where a texture coordinate or a normal is none.
DisplayMesh read_obj_display_mesh(const std::filesystem::path& file);

}  // namespace samara
