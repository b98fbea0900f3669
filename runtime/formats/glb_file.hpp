#pragma once

#include <filesystem>

#include "samara/core/surface/display_mesh.hpp"

namespace samara {

/// All triangles of the scene that a .glb file shows, as its nodes place them at rest, z up; skins, morphs
/// and animations are left out. Of images those of base colours are kept that lie in it as PNG or JPEG.
/// Throws Error, which names the file, where it is no sound glTF 2.0, needs other files or extensions that
/// change its triangles, or has no place for all of them.
DisplayMesh read_glb_file(const std::filesystem::path& file);

/// The same of a .gltf file too, which is text, with the files that it names, where these lie in its folder
/// or beneath.
DisplayMesh read_gltf_file(const std::filesystem::path& file);

}  // namespace samara
