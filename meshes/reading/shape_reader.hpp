#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "samara/core/surface/surface.hpp"

namespace samara {

/// The format of a shape file. gmsh scripts, STEP and BREP files hold exact geometry, which is to be meshed;
/// the others hold a surface of triangles.
enum class ShapeFormat { script, step, brep, stl, obj, ply, off, gltf, three_mf, msh, body };

/// Whether files of the format hold exact geometry.
bool is_geometry(ShapeFormat format);

/// Whether gmsh reads files of the format: exact geometry, and meshes of its own.
bool is_read_by_gmsh(ShapeFormat format);

/// Returns the format of a file by its extension in upper or lower case: .geo, .step, .stp, .brep, .stl,
/// .obj, .ply, .off, .glb, .gltf, .3mf, .msh, .body.h5. Throws Error, which lists these, for another
/// extension, and where the file does not exist.
ShapeFormat shape_format(const std::filesystem::path& file);

/// Throws Error where a STEP, BREP or MSH file does not begin as one: gmsh recognises some by their content,
/// and takes what it does not know for a script. Files of other formats pass.
void require_beginning(const std::filesystem::path& file, ShapeFormat format);

/// Reads the triangles of a file that holds no exact geometry: not welded, not checked, in the file's units
/// (a .3mf in metres). Polygons of .obj, .ply and .off and quadrangles of .msh are cut into triangles; of a
/// .msh the surface elements of order 1 or 2 are read; what .glb, .gltf and .3mf place several times is
/// repeated, and z is up. `time_limit`: CPU seconds for the formats that are read in a separate process.
/// Throws Error where the file cannot be read or holds no triangles.
Surface read_triangles(const std::filesystem::path& file, ShapeFormat format, double time_limit);

/// Reads the triangles of the objects that a 3MF file builds, each with its components and at its place, in
/// metres by the file's unit (lib3mf). Throws Error where lib3mf cannot read it or nothing is built.
Surface read_3mf_file(const std::filesystem::path& file);

/// Calls `read` in a separate process that can only compute and read files below the shape's folder
/// (run_confined), and returns its `count` surfaces: gmsh's files may be programs, and its readers were not
/// written for damaged files. `time_limit`: CPU seconds. The indices of the surfaces are checked to lie
/// within their vertices. Throws Error, one line that names the shape. `progress`: called in this process
/// with the shares of the work that `read` reports.
std::vector<Surface> confined_surfaces(
    const std::filesystem::path& shape, std::size_t count, double time_limit,
    const std::function<std::vector<Surface>(const std::function<void(double)>& progress)>& read,
    const std::function<void(double)>& progress = {});

/// Calls confined_surfaces() for one surface.
Surface confined_surface(const std::filesystem::path& shape, double time_limit,
                         const std::function<Surface(const std::function<void(double)>& progress)>& read,
                         const std::function<void(double)>& progress = {});

/// Reads the faces of a PLY file (text, or binary of either byte order) or an OFF file, cut into triangles;
/// colours, normals and the like are dropped (CGAL). Throws Error where it cannot be read.
Surface read_polygon_file(const std::filesystem::path& file, ShapeFormat format);

/// Throws Error, "LABEL: line N: ...", at the first statement of a gmsh script (.geo) that a shape does not
/// need: one that starts programs (SystemCall, NonBlockingSystemCall, System, OnelabRun, fields of the type
/// ExternalProcess), writes files or makes folders (Save, Print, Printf > and >>, CreateDir), sends data
/// (SendToServer) or ends gmsh (Exit). The check is for a clear message: what it overlooks, for example in
/// included files, the process that reads the script is not permitted to do (confined_surface).
void require_shape_script(std::string_view script, const std::string& label);

}  // namespace samara
