#pragma once

#include <filesystem>

#include "samara/core/surface/display_mesh.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// Reads all triangles of the scene that a .glb file shows, as its nodes place them at rest, in axes with z
/// up. Skins, morphs and animations are left out. Images of base colours are kept where the file holds them
/// as PNG or JPEG. Throws Error, which names the file, where it is no sound glTF 2.0, needs other files or
/// extensions that change its triangles, or has too many of them.
DisplayMesh read_glb_file(const std::filesystem::path& file);

/// Reads a .glb file as read_glb_file() does, or a .gltf file, which is text, with the files that it names,
/// where these lie in its folder or beneath. Throws as read_glb_file().
DisplayMesh read_gltf_file(const std::filesystem::path& file);

/// Reads the mesh of an .obj or .glb file with its texture coordinates, normals and material slots, in the
/// file's axes; a .glb file's y-up axes are rotated to z up. Throws Error, which names the file and the
/// place, where it holds no triangles or has another format.
DisplayMesh read_display_mesh_file(const std::filesystem::path& file);

/// Returns the triangles of a display mesh as a surface of order 1, without texture coordinates and normals.
Surface surface_of(const DisplayMesh& display);

}  // namespace samara
