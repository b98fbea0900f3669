#pragma once

#include <filesystem>
#include <string>

#include "samara/scene/scene.hpp"

namespace samara {

/// Reads a scene file (TOML; every key in docs/scene-file). Paths in it are taken from the scene file's
/// folder. Throws Error naming file, line and remedy: for an unknown key, a wrong type, a value out of range,
/// a missing required key, a shape file that is not there.
Scene read_scene_file(const std::filesystem::path& file);

/// The same for the text of a scene file. `name`: what messages call it, and the scene's file; `folder`:
/// where paths in it are taken from.
Scene read_scene_text(std::string text, const std::string& name, const std::filesystem::path& folder);

}  // namespace samara
