#pragma once

#include <filesystem>

#include "meshes/reading/shape_reader.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// The faces of a PLY file, text or binary of either byte order, or an OFF file, cut into triangles; colours,
/// normals and the like are left out (CGAL). Throws Error where it cannot be read.
Surface read_polygon_file(const std::filesystem::path& file, ShapeFormat format);

}  // namespace samara
