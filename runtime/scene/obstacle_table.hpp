#pragma once

#include <filesystem>

#include "samara/core/physics/emitter.hpp"
#include "samara/core/physics/obstacle.hpp"
#include "samara/formats/toml_table.hpp"

namespace samara {

/// Reads one [[obstacle]] with its mesh; paths are taken from `folder`. Throws Error naming file, line and
/// remedy for what read_scene_file() rejects, and for a mesh that cannot be read or is no sound surface.
Obstacle read_obstacle(TomlTable& table, const std::filesystem::path& folder);

/// Reads the `emitter` of a body, whose mesh has the keys of an obstacle. Throws as read_obstacle(), and
/// where its keys let it jump.
Emitter read_emitter(TomlTable& table, const std::filesystem::path& folder);

}  // namespace samara
