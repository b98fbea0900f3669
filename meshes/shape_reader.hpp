#pragma once

#include <filesystem>

#include "samara/body/surface.hpp"

namespace samara {

/// What a shape file holds, by its name.
enum class ShapeKind {
    geometry,   ///< .geo, .step, .stp, .brep: exact geometry, to be meshed
    triangles,  ///< .stl, .obj, .msh, .body.h5: a surface of triangles
};

/// The kind, by the file's extension in any case of letters. Throws Error, which lists the kinds, for another
/// extension, and where the file does not exist.
ShapeKind shape_kind(const std::filesystem::path& file);

/// The triangles of a file of kind `triangles` as they stand there: not welded, not checked, in the file's
/// units. Polygons of .obj and quadrangles of .msh are cut into triangles; of a .msh the surface elements are
/// taken, of order 1 or 2. Throws Error where the file cannot be read or holds no triangles.
Surface read_triangles(const std::filesystem::path& file);

}  // namespace samara
