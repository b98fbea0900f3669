#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "samara/formats/toml_table.hpp"

namespace samara {

/// The words of a key that holds one of several, and what each stands for.
template <typename Choice>
using Words = std::map<std::string, Choice, std::less<>>;

/// What the key's word stands for; `standard` where the key is not given. Throws Error naming the words where
/// it is none of them.
template <typename Choice>
Choice choice(TomlTable& table, std::string_view key, const Words<Choice>& words, Choice standard) {
    const auto text = table.text(key);
    if (!text) return standard;
    const auto found = words.find(*text);
    if (found != words.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [name, value] : words) names.push_back('"' + name + '"');
    throw table.error(key, fmt::format("must be one of {}, not \"{}\"", fmt::join(names, ", "), *text));
}

}  // namespace samara
