#pragma once

#include <filesystem>

#include "internal/scene/toml_table.hpp"
#include "samara/physics/obstacle.hpp"

namespace samara {

/// Reads one [[obstacle]] with its mesh; paths are taken from `folder`. Throws Error naming file, line and
/// remedy: for what read_scene_file refuses, and for a mesh that cannot be had or is no sound surface.
Obstacle read_obstacle(TomlTable& table, const std::filesystem::path& folder);

}  // namespace samara
