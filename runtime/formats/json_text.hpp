#pragma once

#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

namespace samara {

/// The most lists and objects within each other that are read: what works on JSON may go down by a call for
/// each.
inline constexpr int most_json_depth = 100;

/// What keeps a text from being worked on as JSON, behind its name: "nests more than 100 lists and objects",
/// "is longer than 64 MB"; empty where nothing does, also of what is no JSON.
std::string fault_of_json_size(std::string_view text);

/// The value of a JSON text. Throws Error, "is no JSON (REASON)" or fault_of_json_size().
nlohmann::json parse_json(std::string_view text);

/// parse_json(), where is_discarded() holds for what it refuses.
nlohmann::json parse_json_or_discard(std::string_view text);

}  // namespace samara
