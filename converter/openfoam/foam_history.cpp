#include "converter/openfoam/foam_history.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "converter/openfoam/foam_scanner.hpp"
#include "samara/core/base/error.hpp"

namespace samara {

std::optional<double> time_of(const std::filesystem::path& folder) {
    const std::string name = folder.filename().string();
    double time = 0.0;
    const auto [end, status] = std::from_chars(name.data(), name.data() + name.size(), time);
    const bool is_number = status == std::errc() && end == name.data() + name.size() && std::isfinite(time);
    return is_number ? std::optional(time) : std::nullopt;
}

std::vector<TimeFolder> time_folders(const std::filesystem::path& folder) {
    std::vector<TimeFolder> folders;
    if (!std::filesystem::is_directory(folder)) return folders;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        const std::optional<double> time = time_of(entry.path());
        if (time && entry.is_directory()) folders.push_back({*time, entry.path()});
    }
    std::sort(folders.begin(), folders.end(),
              [](const TimeFolder& a, const TimeFolder& b) { return a.time < b.time; });
    return folders;
}

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

/// Removes the brackets that enclose several columns, as in "(total_x"; those of "volAverage(k)" stay.
std::string_view without_vector_brackets(std::string_view word) {
    while (word.starts_with('(')) word.remove_prefix(1);
    const auto unbalanced = [](std::string_view text) {
        return std::count(text.begin(), text.end(), ')') > std::count(text.begin(), text.end(), '(');
    };
    while (word.ends_with(')') && unbalanced(word)) word.remove_suffix(1);
    return word;
}

void append_vector(std::vector<std::string>& names, const std::string& vector) {
    for (const char* const axis : {"_x", "_y", "_z"}) names.push_back(vector + axis);
}

/// Returns the names of columns in a heading such as "Time (total_x total_y total_z)", "Time volAverage(k)",
/// or "Time forces(pressure viscous) moments(pressure viscous)", whose words in brackets are vectors.
std::vector<std::string> column_names(std::string_view comment) {
    std::vector<std::string> names;
    std::string group;  // "forces_" between its brackets
    for (const std::string_view word : split(comment)) {
        const std::size_t bracket = word.find('(');
        const bool opens = bracket != std::string_view::npos && bracket > 0 && !word.ends_with(')');
        if (opens) {
            group = std::string(word.substr(0, bracket)) + "_";
            append_vector(names, group + std::string(word.substr(bracket + 1)));
        } else if (!group.empty()) {
            const bool closes = word.ends_with(')');
            append_vector(names, group + std::string(word.substr(0, word.size() - (closes ? 1 : 0))));
            if (closes) group.clear();
        } else {
            names.emplace_back(without_vector_brackets(word));
        }
    }
    return names;
}

std::vector<double> numbers_in(std::string_view line) {
    std::vector<double> row;
    for (std::string_view word : split(line)) {
        word = without_vector_brackets(word);
        double value = 0.0;
        const char* const end = word.data() + word.size();
        if (word.empty() || read_foam_number(word.data(), end, value) != end) {
            throw Error(fmt::format("expected a number, found '{}'", word));
        }
        row.push_back(value);
    }
    return row;
}

/// Replaces the names of vectors by those of their components, as for sixDoFRigidBodyState, whose heading has
/// one word for each vector: where the first row has as many numbers and bracketed triples as there are
/// names.
void name_components(std::vector<std::string>& columns, std::string_view row) {
    std::vector<std::string> named;
    std::size_t column = 0;
    bool in_brackets = false;
    for (const std::string_view word : split(row)) {
        const bool opens = word.starts_with('(') && !word.ends_with(')');
        if (!in_brackets) {
            if (column == columns.size()) return;
            const std::string& name = columns[column++];
            if (opens) {
                append_vector(named, name);
            } else {
                named.push_back(name);
            }
        }
        in_brackets = (in_brackets || opens) && !word.ends_with(')');
    }
    if (column == columns.size()) columns = std::move(named);
}

void append_row(FoamHistory& history, std::vector<double> row) {
    if (row.empty()) return;
    if (row.size() != history.columns.size()) {
        throw Error(fmt::format("has {} values for {} columns", row.size(), history.columns.size()));
    }
    if (!std::isfinite(row.front())) throw Error(fmt::format("{} is not a time", row.front()));
    if (!history.rows.empty() && !(row.front() > history.rows.back().front())) {
        throw Error(fmt::format("the time {:.10g} comes after {:.10g}; times must ascend", row.front(),
                                history.rows.back().front()));
    }
    history.rows.push_back(std::move(row));
}

/// Reads a file like read_history(), which may have no values.
FoamHistory read_rows(const std::filesystem::path& file, CutLine cut_line) {
    const FoamBytes bytes = read_foam_bytes(file);
    const std::string_view text = bytes.text;
    FoamHistory history{bytes.path, {}, {}, {}};
    int line_number = 0;
    for (std::size_t start = 0; start < text.size();) {
        const std::size_t end = text.find('\n', start);
        const std::string_view line = text.substr(start, end - start);
        const bool cut = end == std::string_view::npos;
        start = cut ? text.size() : end + 1;
        ++line_number;
        try {
            if (line.starts_with('#')) {
                if (history.rows.empty()) history.columns = column_names(line.substr(1));
            } else if (!cut) {
                if (history.rows.empty()) name_components(history.columns, line);
                append_row(history, numbers_in(line));
            } else if (cut_line == CutLine::reject) {
                throw Error("ends within this line; let the solver continue, or remove the line");
            }
        } catch (const Error& error) {
            throw Error(fmt::format("{}:{}: {}", bytes.path.string(), line_number, error.what()));
        }
    }
    return history;
}

void require_rows(const FoamHistory& history) {
    if (history.rows.empty()) {
        throw Error(fmt::format("{}: holds no values; the case was not solved", history.file.string()));
    }
}

/// Throws where a run begins before its start time: then its file is a copy of another run's.
void require_times_of_run(const FoamHistory& part, double run_start) {
    const double first = part.rows.front().front();
    if (first >= run_start * (1.0 - 1e-6)) return;
    throw Error(
        fmt::format("{}: begins at the time {:.10g}, before its folder's start time, so it belongs to "
                    "another run; remove it",
                    part.file.string(), first));
}

}  // namespace

FoamHistory read_history(const std::filesystem::path& file, CutLine cut_line) {
    FoamHistory history = read_rows(file, cut_line);
    require_rows(history);
    history.files.add(history.rows.front().front(), history.file);
    return history;
}

std::vector<std::filesystem::path> history_files(const std::filesystem::path& folder,
                                                 const std::string& name) {
    std::vector<std::filesystem::path> files;
    for (const TimeFolder& run : time_folders(folder)) {
        const std::string time = run.path.filename().string();
        for (const std::string& file : {name + ".dat", fmt::format("{}_{}.dat", name, time)}) {
            if (foam_file_exists(run.path / file)) files.push_back(run.path / file);
        }
    }
    return files;
}

FoamHistory read_joined_history(const std::filesystem::path& folder, const std::string& name) {
    const std::vector<std::filesystem::path> files = history_files(folder, name);
    if (files.empty()) {
        throw Error(fmt::format(
            "{}: has no {}.dat in any folder of a start time; solve the case with the function object '{}'",
            folder.string(), name, folder.filename().string()));
    }
    FoamHistory joined;
    for (const std::filesystem::path& file : files) {
        FoamHistory part = read_rows(file, file == files.back() ? CutLine::reject : CutLine::drop);
        joined.file = part.file;
        if (part.rows.empty()) continue;
        if (!joined.rows.empty() && part.columns != joined.columns) {
            throw Error(fmt::format("{}: its columns differ from those of earlier runs; solve the case again",
                                    file.string()));
        }
        joined.columns = std::move(part.columns);
        const double first = part.rows.front().front();
        require_times_of_run(part, *time_of(file.parent_path()));
        joined.files.add(first, file);
        const auto later = [&](const std::vector<double>& row) { return row.front() >= first; };
        joined.rows.erase(std::find_if(joined.rows.begin(), joined.rows.end(), later), joined.rows.end());
        std::move(part.rows.begin(), part.rows.end(), std::back_inserter(joined.rows));
    }
    require_rows(joined);
    return joined;
}

void HistoryFiles::add(double first, std::filesystem::path file) {
    while (!files_.empty() && files_.back().first >= first) files_.pop_back();
    files_.emplace_back(first, std::move(file));
}

const std::filesystem::path& HistoryFiles::at(double time) const {
    const auto later = std::upper_bound(files_.begin(), files_.end(), time,
                                        [](double value, const auto& file) { return value < file.first; });
    return later == files_.begin() ? files_.front().second : std::prev(later)->second;
}

bool FoamHistory::has(const std::string& name) const {
    return std::find(columns.begin(), columns.end(), name) != columns.end();
}

std::size_t FoamHistory::index(const std::string& name) const {
    const auto found = std::find(columns.begin(), columns.end(), name);
    if (found == columns.end()) throw Error(fmt::format("{}: has no column '{}'", file.string(), name));
    return static_cast<std::size_t>(found - columns.begin());
}

std::vector<double> FoamHistory::column(const std::string& name, double start) const {
    const std::size_t place = index(name);
    std::vector<double> values;
    for (const std::vector<double>& row : rows) {
        if (row.front() >= start) values.push_back(row[place]);
    }
    return values;
}

}  // namespace samara
