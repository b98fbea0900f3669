#pragma once

#include <cstddef>
#include <filesystem>

#include "samara/core/surface/display_mesh.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// The most corners of one face of an OBJ file: the time to cut it may grow with their square.
inline constexpr std::size_t most_obj_corners = 10'000;

/// Returns the triangles of a Wavefront OBJ file: its vertices and faces without the rest; polygons are cut
/// into triangles (polygon_triangles). Throws Error, which names the line, where a vertex or face is invalid.
Surface read_obj_file(const std::filesystem::path& file);

/// Returns the triangles of a Wavefront OBJ file with texture coordinates, normals (where all corners have
/// one) and the materials that its faces use, in the order of their use. The materials come from the .mtl
/// files that it names, where these exist. Throws Error, which names the line, where a vertex, face, texture
/// coordinate or normal is invalid.
DisplayMesh read_obj_display_mesh(const std::filesystem::path& file);

}  // namespace samara
