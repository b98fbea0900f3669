#pragma once

#include <filesystem>

#include "samara/core/wind/wind.hpp"
#include "samara/formats/toml_table.hpp"

namespace samara {

/// Reads [wind]. `folder`: the folder that paths in it are relative to; `ground` (m): where a profile begins
/// that names no ground of its own; `end` (s): of the scene, until when a wind file must last. Throws Error
/// naming file, line and remedy for what read_scene_file() rejects.
Wind read_wind(TomlTable& table, const std::filesystem::path& folder, double ground, double end);

}  // namespace samara
