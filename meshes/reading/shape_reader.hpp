#pragma once

#include <filesystem>

#include "meshes/reading/shape_format.hpp"
#include "samara/body/surface.hpp"

namespace samara {

/// The triangles of a .stl, .obj, .msh or .body.h5 file as they stand there: not welded, not checked, in the
/// file's units. Polygons of .obj and quadrangles of .msh are cut into triangles; of a .msh the surface
/// elements are taken, of order 1 or 2. `time_limit`: seconds of computing that gmsh may take.
/// Throws Error where the file cannot be read or holds no triangles.
Surface read_triangles(const std::filesystem::path& file, ShapeFormat format, double time_limit);

}  // namespace samara
