#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/base/numbers.hpp"

namespace samara {

/// Parses a TOML text; `file` is the name for messages. Throws Error with the file and the line.
toml::table parse_toml(std::string_view text, const std::string& file);

/// Bounds of a number, with the words for a message: "must be above 0".
struct NumberRange {
    double lowest;
    double highest;
    std::string_view words;
    bool or_zero = false;  ///< whether 0 is allowed as well
};

inline constexpr NumberRange any_number = {-largest_number, largest_number,
                                           "must be a finite number, 1e30 at most"};
inline constexpr NumberRange positive_number = {smallest_number, largest_number,
                                                "must be a finite number above 0, from 1e-60 to 1e30"};
inline constexpr NumberRange non_negative_number = {
    smallest_number, largest_number, "must be 0, or a finite number above 0, from 1e-60 to 1e30", true};

/// Reads the keys of one TOML table and remembers which were asked for, so that an unknown key can be named.
/// Every fault throws Error with the file and the line.
class TomlTable {
  public:
    /// `where`: the table's name for messages, as in "[fluid]".
    TomlTable(const toml::table& table, std::string file, std::string where);

    std::optional<double> number(std::string_view key, const NumberRange& range);
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
