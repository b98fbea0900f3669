#pragma once

#include <filesystem>

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

}  // namespace samara
