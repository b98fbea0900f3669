#pragma once

#include <filesystem>

#include "samara/core/surface/surface.hpp"

namespace samara {

/// What a shape file is, by its name: gmsh scripts, STEP and BREP hold exact geometry, to be meshed; the
/// others a surface of triangles.
enum class ShapeFormat { script, step, brep, stl, obj, ply, off, gltf, three_mf, msh, body };

/// Whether files of the format hold exact geometry.
bool is_geometry(ShapeFormat format);

/// Whether gmsh reads files of the format: exact geometry, and meshes of its own.
bool is_read_by_gmsh(ShapeFormat format);

/// The format, by the file's extension in any case of letters: .geo, .step, .stp, .brep, .stl, .obj, .ply,
/// .off, .glb, .gltf, .3mf, .msh, .body.h5. Throws Error, which lists these, for another extension, and where
/// the file does not exist.
ShapeFormat shape_format(const std::filesystem::path& file);

/// Throws Error where a STEP, BREP or MSH file does not begin as one: gmsh goes by the content of some, and
/// takes what it does not know for a script. Files of other formats pass.
void require_beginning(const std::filesystem::path& file, ShapeFormat format);

/// The triangles of a file that holds no exact geometry as they stand there: not welded, not checked, in the
/// file's units, those of a .3mf in metres. Polygons of .obj, .ply and .off and quadrangles of .msh are cut
/// into triangles; of a .msh the surface elements are taken, of order 1 or 2; what .glb, .gltf and .3mf place
/// several times is there several times, and z is up. `time_limit`: seconds of computing for the readers that
/// are run in a process of their own. Throws Error where the file cannot be read or holds no triangles.
Surface read_triangles(const std::filesystem::path& file, ShapeFormat format, double time_limit);

/// The triangles of the objects that a 3MF file has built, each with its components and where it is placed,
/// in metres by the file's unit (lib3mf). Throws Error where lib3mf cannot read it or nothing is built.
Surface read_3mf_file(const std::filesystem::path& file);

}  // namespace samara
