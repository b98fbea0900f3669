#pragma once

#include "internal/scene/toml_table.hpp"
#include "samara/physics/wind.hpp"

namespace samara {

/// Reads [wind]. `ground` (m) is where a profile begins that names no ground of its own. Throws Error naming
/// file, line and remedy for what read_scene_file refuses.
Wind read_wind(TomlTable& table, double ground);

}  // namespace samara
