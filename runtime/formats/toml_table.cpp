#include "samara/formats/toml_table.hpp"

#include <algorithm>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/text.hpp"

namespace samara {
namespace {

constexpr int most_parts = 8;

/// Returns the place behind the string that begins at `begin` with one of the quotes ' and ", or with three;
/// behind the line's end where it is not closed, which the parser rejects.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
    const char quote = text[begin];
    const std::string three(3, quote);
    const bool long_one = text.substr(begin, 3) == three;
    std::size_t at = begin + (long_one ? 3 : 1);
    while (at < text.size()) {
        if (text[at] == '\\' && quote == '"') {
            at += 2;
        } else if (long_one && text.substr(at, 3) == three) {
            at += 3;
            for (int i = 0; i < 2 && at < text.size() && text[at] == quote; ++i)
                ++at;  // they end the content
            return at;
        } else if (!long_one && (text[at] == quote || text[at] == '\n')) {
            return at + 1;
        } else {
            ++at;
        }
    }
    return text.size();
}

/// Throws Error, which names the file and the line, where a key of the TOML text has more parts, joined by
/// dots, than any of ours: each part is a table within a table, and the parser takes them apart one call
/// within another, which many thousands of them do not survive. Arrays and tables in braces it counts itself.
void require_short_keys(std::string_view text, const std::string& file) {
    int parts = 1;
    for (std::size_t at = 0; at < text.size();) {
        const char letter = text[at];
        if (letter == '"' || letter == '\'') {
            at = end_of_string(text, at);
            continue;
        }
        if (letter == '#') {
            at = std::min(text.find('\n', at), text.size());
            continue;
        }
        if (std::string_view("=,[]{}\n").find(letter) != std::string_view::npos) parts = 1;
        if (letter == '.' && ++parts > most_parts) {
            const auto line =
                1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
            throw Error(fmt::format("{}:{}: a key has more than {} parts joined by dots; shorten it", file,
                                    line, most_parts));
        }
        ++at;
    }
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& file) {
    require_short_keys(text, file);
    try {
        return toml::parse(text, file);
    } catch (const toml::parse_error& error) {
        throw Error(fmt::format("{}:{}: {}", file, error.source().begin.line, error.description()));
    }
}

TomlTable::TomlTable(const toml::table& table, std::string file, std::string where)
    : table_(&table), file_(std::move(file)), where_(std::move(where)) {}

Error TomlTable::error(std::string_view key, std::string_view what) const {
    const toml::node* found = table_->get(key);
    if (found == nullptr) require_no_misspelling(key);
    const auto line = (found != nullptr ? found->source() : table_->source()).begin.line;
    return Error(fmt::format("{}:{}: {} in {} {}", file_, line, key, where_, what));
}

void TomlTable::require_no_misspelling(std::string_view key) const {
    const auto bare = key.substr(key.starts_with('[') ? 1 : 0);
    const std::vector<std::string> meant = {std::string(bare.substr(0, bare.find(']')))};
    for (const auto& [written, value] : *table_) {
        if (known_.contains(written.str()) || nearest_word(written.str(), meant).empty()) continue;
        throw unknown_key(written, meant);
    }
}

Error TomlTable::unknown_key(const toml::key& key, const std::vector<std::string>& keys) const {
    const std::string meant = did_you_mean(key.str(), keys);
    return Error(
        fmt::format("{}:{}: unknown key '{}' in {}{}", file_, key.source().begin.line, key.str(), where_,
                    meant.empty() ? fmt::format("; the keys are: {}", fmt::join(keys, ", ")) : meant));
}

const toml::node* TomlTable::node(std::string_view key) {
    known_.emplace(key);
    return table_->get(key);
}

double TomlTable::finite_number(std::string_view key, const toml::node& node,
                                const NumberRange& range) const {
    const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
    const bool fits = value && range.holds(*value);
    if (!fits && node.is_string()) {
        throw error(key,
                    fmt::format("must be a number without a unit, in SI units (m, kg, s, rad), not \"{}\"",
                                node.ref<std::string>()));
    }
    if (!fits) throw error(key, range.words);
    return *value;
}

std::optional<double> TomlTable::number(std::string_view key, const NumberRange& range) {
    const toml::node* found = node(key);
    if (found == nullptr) return std::nullopt;
    return finite_number(key, *found, range);
}

std::optional<std::int64_t> TomlTable::integer(std::string_view key, std::int64_t lowest,
                                               std::int64_t highest) {
    const toml::node* found = node(key);
    if (found == nullptr) return std::nullopt;
    const std::optional<std::int64_t> value =
        found->is_integer() ? found->value<std::int64_t>() : std::nullopt;
    if (!value || *value < lowest || *value > highest) {
        throw error(key, fmt::format("must be a whole number from {} to {}", lowest, highest));
    }
    return value;
}

std::optional<std::string> TomlTable::text(std::string_view key) {
    const toml::node* found = node(key);
    if (found == nullptr) return std::nullopt;
    if (!found->is_string()) throw error(key, "must be a string in quotes");
    return found->value<std::string>();
}

std::optional<bool> TomlTable::boolean(std::string_view key) {
    const toml::node* found = node(key);
    if (found == nullptr) return std::nullopt;
    if (!found->is_boolean()) throw error(key, "must be true or false");
    return found->value<bool>();
}

std::optional<std::vector<double>> TomlTable::numbers(std::string_view key, std::size_t length) {
    const toml::node* found = node(key);
    if (found == nullptr) return std::nullopt;
    const toml::array* array = found->as_array();
    if (array == nullptr || array->size() != length)
        throw error(key, fmt::format("must be a list of {} numbers", length));
    std::vector<double> values;
    for (const toml::node& element : *array) {
        values.push_back(finite_number(
            key, element, {any_number.lowest, any_number.highest, "must hold finite numbers, 1e30 at most"}));
    }
    return values;
}

std::optional<Vector3d> TomlTable::vector(std::string_view key) {
    const auto values = numbers(key, 3);
    if (!values) return std::nullopt;
    return Vector3d(values->data());
}

std::optional<Quaterniond> TomlTable::orientation() {
    const auto angles = vector("rotation");
    const auto given = quaternion("orientation");
    if (!angles) return given;
    if (given) throw error("rotation", "excludes orientation; give one of the two");
    const Vector3d radians = std::numbers::pi / 180.0 * *angles;
    return Quaterniond(Eigen::AngleAxisd(radians.z(), Vector3d::UnitZ()) *
                       Eigen::AngleAxisd(radians.y(), Vector3d::UnitY()) *
                       Eigen::AngleAxisd(radians.x(), Vector3d::UnitX()));
}

std::optional<Quaterniond> TomlTable::quaternion(std::string_view key) {
    const auto values = numbers(key, 4);
    if (!values) return std::nullopt;
    const Quaterniond quaternion((*values)[0], (*values)[1], (*values)[2], (*values)[3]);
    if (quaternion.norm() < 1e-6) throw error(key, "must be a quaternion (w, x, y, z) that is not zero");
    return quaternion.normalized();
}

std::optional<TomlTable> TomlTable::table(std::string_view key) {
    const toml::node* found = node(key);
    if (found == nullptr) return std::nullopt;
    if (!found->is_table()) throw error(key, "must be a table");
    return TomlTable(*found->as_table(), file_, fmt::format("[{}]", key));
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) {
    std::vector<TomlTable> result;
    const toml::node* found = node(key);
    if (found == nullptr) return result;
    if (!found->is_array_of_tables()) throw error(key, fmt::format("must be written as [[{}]]", key));
    for (const toml::node& element : *found->as_array()) {
        result.emplace_back(*element.as_table(), file_, fmt::format("[[{}]]", key));
    }
    return result;
}

void TomlTable::finish() const {
    for (const auto& [key, value] : *table_) {
        if (known_.contains(key.str())) continue;
        throw unknown_key(key, {known_.begin(), known_.end()});
    }
}

}  // namespace samara
