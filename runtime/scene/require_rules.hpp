#pragma once

#include <optional>

#include "samara/core/physics/broken_rule.hpp"
#include "samara/formats/toml_table.hpp"

namespace samara {

/// Throws Error naming file, line and key where a rule is broken by what was read from a table of a scene.
/// `table`: in which the path of the rule's member begins.
void require_rules(TomlTable& table, const std::optional<BrokenRule>& broken);

}  // namespace samara
