#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/base/number_limits.hpp"

namespace samara {

/// Parses a TOML text; `file` is the name for messages. Throws Error with the file and the line.
toml::table parse_toml(std::string_view text, const std::string& file);

/// Reads the keys of one TOML table and remembers which were asked for, so that an unknown key can be named.
/// Every fault throws Error with the file and the line.
class TomlTable {
  public:
    /// `where`: the table's name for messages, as in "[fluid]".
    TomlTable(const toml::table& table, std::string file, std::string where);

    std::optional<double> number(std::string_view key, const NumberRange& range = any_number);
    std::optional<std::int64_t> integer(std::string_view key, std::int64_t lowest, std::int64_t highest);
    std::optional<std::string> text(std::string_view key);
    std::optional<bool> boolean(std::string_view key);
    /// `length` finite numbers.
    std::optional<std::vector<double>> numbers(std::string_view key, std::size_t length);
    std::optional<Vector3d> vector(std::string_view key);
    /// A turn as (w, x, y, z), made one of length one.
    std::optional<Quaterniond> quaternion(std::string_view key);
    std::optional<TomlTable> table(std::string_view key);
    /// The tables of an array of tables, [[key]].
    std::vector<TomlTable> tables(std::string_view key);
    const toml::node* node(std::string_view key);

    /// Throws where the table holds a key that was never asked for, naming the one that was meant, or all.
    void finish() const;

    /// What is wrong with a key; of one that is missing, the key that is it misspelt.
    [[nodiscard]] Error error(std::string_view key, std::string_view what) const;

  private:
    /// Throws where one of the unknown keys is this one misspelt.
    void require_no_slip(std::string_view key) const;
    Error unknown_key(const toml::key& key, const std::vector<std::string>& keys) const;
    double finite_number(std::string_view key, const toml::node& node, const NumberRange& range) const;

    const toml::table* table_;
    std::string file_;
    std::string where_;
    std::set<std::string, std::less<>> known_;
};

}  // namespace samara
