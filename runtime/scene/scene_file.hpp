#pragma once

#include <filesystem>
#include <string>

#include "samara/scene/scene.hpp"

namespace samara {

/// Reads a scene file (TOML; every key in docs/reference/scene-file.md). Paths in it are taken from the scene
/// file's folder. Throws Error naming file, line and remedy: for an unknown key, a wrong type, a value out of
/// range, a missing required key, a shape file that is not there.
Scene read_scene_file(const std::filesystem::path& file);

/// Reads the text of a scene file; errors as for read_scene_file(). `name`: its name in messages, and the
/// scene's file; `folder`: the folder that paths in it are relative to.
Scene read_scene_text(std::string text, const std::string& name, const std::filesystem::path& folder);

}  // namespace samara
