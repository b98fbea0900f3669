#pragma once

#include <string>
#include <string_view>

namespace samara {

/// Throws Error, which names the file and the line, where a key of the TOML text has more parts, joined by
/// dots, than any of ours: each part is a table within a table, and the parser takes them apart one call
/// within another, which many thousands of them do not survive. Arrays and tables in braces it counts itself.
void require_short_keys(std::string_view text, const std::string& file);

}  // namespace samara
