#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/base/numbers.hpp"

namespace samara {

/// Parses a TOML text; `file` is the name for messages. Throws Error with the file and the line.
toml::table parse_toml(std::string_view text, const std::string& file);

/// Reads the keys of one TOML table and remembers which were asked for, so that an unknown key can be named.
/// Every error of the file throws Error with the file and the line. The readers of a key return nothing where
/// the table does not have it.
class TomlTable {
  public:
    /// Wraps a table of `file`. `where`: the table's name for messages, as in "[fluid]".
    TomlTable(const toml::table& table, std::string file, std::string where);

    /// Reads a number within `range`.
    std::optional<double> number(std::string_view key, const NumberRange& range = any_number);
    /// Reads a whole number from `lowest` to `highest`.
    std::optional<std::int64_t> integer(std::string_view key, std::int64_t lowest, std::int64_t highest);
    /// Reads a text.
    std::optional<std::string> text(std::string_view key);
    /// Reads true or false.
    std::optional<bool> boolean(std::string_view key);
    /// Reads a list of `length` finite numbers.
    std::optional<std::vector<double>> numbers(std::string_view key, std::size_t length);
    /// Reads a list of three finite numbers.
    std::optional<Vector3d> vector(std::string_view key);
    /// Reads a rotation as the list (w, x, y, z), and normalises it.
    std::optional<Quaterniond> quaternion(std::string_view key);
    /// Returns what `orientation` (a quaternion) or `rotation` says: degrees about the world's x axis, then
    /// its y, then its z, which Blender calls XYZ Euler.
    std::optional<Quaterniond> orientation();
    /// Reads a table within this one.
    std::optional<TomlTable> table(std::string_view key);
    /// Reads an array of tables, [[key]]; empty where there is none.
    std::vector<TomlTable> tables(std::string_view key);
    /// Returns the value of a key, of any type; null where there is none.
    const toml::node* node(std::string_view key);

    /// Throws Error where the table holds a key that was never asked for, naming the key that was probably
    /// meant, or else all keys.
    void finish() const;

    /// Returns the Error that says what is wrong with a key. Throws instead where the key is missing and
    /// another one looks like its misspelling: then that one is named.
    [[nodiscard]] Error error(std::string_view key, std::string_view what) const;

  private:
    /// Throws Error where an unknown key of the table looks like a misspelling of this one.
    void require_no_misspelling(std::string_view key) const;
    Error unknown_key(const toml::key& key, const std::vector<std::string>& keys) const;
    double finite_number(std::string_view key, const toml::node& node, const NumberRange& range) const;

    const toml::table* table_;
    std::string file_;
    std::string where_;
    std::set<std::string, std::less<>> known_;
};

/// The words that a key may hold, and the value of each.
template <typename Choice>
using Words = std::map<std::string, Choice, std::less<>>;

/// Returns the value of the key's word; `standard` where the key is not given. Throws Error, which names the
/// words, where the table holds another.
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
