#pragma once

#include <string_view>

#include <nlohmann/json.hpp>

namespace samara {

/// The value of a JSON text. Throws Error, "is no JSON (REASON)" or error_of_json_size().
nlohmann::json parse_json(std::string_view text);

/// parse_json(), where is_discarded() holds for what parse_json() throws for.
nlohmann::json parse_json_or_discard(std::string_view text);

}  // namespace samara
