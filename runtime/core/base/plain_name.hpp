#pragma once

#include <string_view>

namespace samara {

/// What is wrong with one that is not, in words to stand behind "name".
inline constexpr std::string_view plain_name_words =
    "may hold letters, digits, '-' and '_' alone, 64 at most";

/// Whether a name of a body or an obstacle can stand in files of all kinds: letters, digits, '-' and '_', 64
/// at most.
inline bool is_plain_name(std::string_view name) {
    constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
    return !name.empty() && name.size() <= 64 && name.find_first_not_of(allowed) == std::string_view::npos;
}

}  // namespace samara
