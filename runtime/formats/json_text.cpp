#include "samara/formats/json_text.hpp"

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/files/input_file.hpp"

namespace samara {

nlohmann::json parse_json(std::string_view text) {
    if (const std::string error = error_of_json_size(text); !error.empty()) throw Error(error);
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& reason) {
        throw Error(fmt::format("is not valid JSON ({})", reason.what()));
    }
}

nlohmann::json parse_json_or_discard(std::string_view text) {
    if (!error_of_json_size(text).empty()) return nlohmann::json(nlohmann::json::value_t::discarded);
    return nlohmann::json::parse(text, nullptr, false);
}

}  // namespace samara
