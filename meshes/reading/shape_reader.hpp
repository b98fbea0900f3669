#pragma once

#include <filesystem>

#include "meshes/reading/shape_format.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// The triangles of a file that holds no exact geometry as they stand there: not welded, not checked, in the
/// file's units, those of a .3mf in metres. Polygons of .obj, .ply and .off and quadrangles of .msh are cut
/// into triangles; of a .msh the surface elements are taken, of order 1 or 2; what .glb, .gltf and .3mf place
/// several times is there several times, and z is up. `time_limit`: seconds of computing for the readers that
/// are run in a process of their own. Throws Error where the file cannot be read or holds no triangles.
Surface read_triangles(const std::filesystem::path& file, ShapeFormat format, double time_limit);

}  // namespace samara
