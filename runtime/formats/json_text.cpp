#include "samara/formats/json_text.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

constexpr std::size_t most_bytes = 64U << 20U;

/// How many lists and objects are open at once; of what is no JSON, at least as many as a parser sees open
/// before it finds out.
int depth_of(std::string_view text) {
    int depth = 0;
    int deepest = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char letter = text[i];
        if (in_string) {
            if (letter == '\\') ++i;  // what follows ends no string
            in_string = letter != '"';
        } else if (letter == '"') {
            in_string = true;
        } else if (letter == '[' || letter == '{') {
            deepest = std::max(deepest, ++depth);
        } else if (letter == ']' || letter == '}') {
            --depth;
        }
    }
    return deepest;
}

}  // namespace

std::string fault_of_json_size(std::string_view text) {
    if (text.size() > most_bytes) return fmt::format("is longer than {} MB", most_bytes >> 20U);
    if (depth_of(text) <= most_json_depth) return {};
    return fmt::format("nests more than {} lists and objects", most_json_depth);
}

nlohmann::json parse_json(std::string_view text) {
    if (const std::string fault = fault_of_json_size(text); !fault.empty()) throw Error(fault);
    try {
        return nlohmann::json::parse(text);
    } catch (const nlohmann::json::exception& reason) {
        throw Error(fmt::format("is no JSON ({})", reason.what()));
    }
}

nlohmann::json parse_json_or_discard(std::string_view text) {
    if (!fault_of_json_size(text).empty()) return nlohmann::json(nlohmann::json::value_t::discarded);
    return nlohmann::json::parse(text, nullptr, false);
}

}  // namespace samara
