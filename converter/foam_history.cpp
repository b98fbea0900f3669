#include "converter/foam_history.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>

#include <fmt/format.h>

#include "samara/base/content_hash.hpp"
#include "samara/base/error.hpp"

namespace samara {
namespace {

std::vector<std::string_view> split(std::string_view line) {
    constexpr std::string_view blanks = " \t\r";
    std::vector<std::string_view> words;
    for (std::size_t start = line.find_first_not_of(blanks); start != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(blanks, start), line.size());
        words.push_back(line.substr(start, end - start));
        start = line.find_first_not_of(blanks, end);
    }
    return words;
}

/// Without the brackets that enclose several columns, as in "(total_x"; those of "volAverage(k)" stay.
std::string_view without_vector_brackets(std::string_view word) {
    while (word.starts_with('(')) word.remove_prefix(1);
    const auto unbalanced = [](std::string_view text) {
        return std::count(text.begin(), text.end(), ')') > std::count(text.begin(), text.end(), '(');
    };
    while (word.ends_with(')') && unbalanced(word)) word.remove_suffix(1);
    return word;
}

std::vector<std::string> column_names(std::string_view comment) {
    std::vector<std::string> names;
    for (const std::string_view word : split(comment)) names.emplace_back(without_vector_brackets(word));
    return names;
}

}  // namespace

FoamHistory read_history(const std::filesystem::path& file) {
    const std::string text = read_bytes(file);
    FoamHistory history{file, {}, {}};
    int line_number = 0;
    const auto fault = [&](const std::string& what) {
        return Error(fmt::format("{}:{}: {}", file.string(), line_number, what));
    };
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = std::min(text.find('\n', start), text.size());
        const std::string_view line = std::string_view(text).substr(start, end - start);
        start = end + 1;
        ++line_number;
        if (line.starts_with('#')) {
            if (history.rows.empty()) history.columns = column_names(line.substr(1));
            continue;
        }
        std::vector<double> row;
        for (std::string_view word : split(line)) {
            word = without_vector_brackets(word);
            double value = 0.0;
            const auto [rest, status] = std::from_chars(word.data(), word.data() + word.size(), value);
            if (status == std::errc::invalid_argument || rest != word.data() + word.size()) {
                throw fault(fmt::format("expected a number, found '{}'", word));
            }
            row.push_back(value);
        }
        if (row.empty()) continue;
        if (row.size() != history.columns.size()) {
            throw fault(fmt::format("has {} values for {} columns", row.size(), history.columns.size()));
        }
        history.rows.push_back(std::move(row));
    }
    if (history.rows.empty()) throw fault("holds no values; the case was not solved");
    return history;
}

std::vector<double> FoamHistory::column(const std::string& name, double start) const {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found == columns.end()) throw Error(fmt::format("{}: has no column '{}'", file.string(), name));
    const auto index = static_cast<std::size_t>(found - columns.begin());
    std::vector<double> values;
    for (const std::vector<double>& row : rows) {
        if (row.front() >= start) values.push_back(row[index]);
    }
    return values;
}

}  // namespace samara
