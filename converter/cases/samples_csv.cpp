#include "converter/cases/samples_csv.hpp"

#include <charconv>
#include <sstream>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"

namespace samara {
namespace {

constexpr const char* heading =
    "name,purpose,mesh,closure,direction_x,direction_y,direction_z,reynolds_number,"
    "force_x,force_y,force_z,moment_x,moment_y,moment_z,turbulent_kinetic_energy,dissipation_rate,"
    "force_error_x,force_error_y,force_error_z,moment_error_x,moment_error_y,moment_error_z,"
    "turbulent_kinetic_energy_error,dissipation_rate_error\n";

/// Quotes a text by RFC 4180 where it holds a separator.
std::string quoted(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    return quoted + '"';
}

std::string columns(const Vector3d& vector) {
    return fmt::format("{},{},{}", vector.x(), vector.y(), vector.z());
}

std::string columns(const LoadEntry& entry) {
    return fmt::format("{},{},{},{}", columns(entry.force), columns(entry.moment),
                       entry.turbulent_kinetic_energy, entry.dissipation_rate);
}

constexpr std::size_t column_count = 24;

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> words(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const bool doubled = quoted && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"';
        if (doubled) ++i;
        if (line[i] == '"' && !doubled) {
            quoted = !quoted;
        } else if (line[i] == ',' && !quoted) {
            words.emplace_back();
        } else {
            words.back() += line[i];
        }
    }
    return words;
}

double number(const std::string& word) {
    double value = 0.0;
    const auto [end, status] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (status != std::errc() || end != word.data() + word.size()) {
        throw Error(fmt::format("expected a number, found '{}'", word));
    }
    return value;
}

SolvedCase row_of(const std::vector<std::string>& words) {
    if (words.size() != column_count) {
        throw Error(fmt::format("has {} columns instead of {}", words.size(), column_count));
    }
    std::size_t column = 4;
    const auto next = [&] { return number(words[column++]); };
    const auto next_vector = [&] {
        const double x = next();
        const double y = next();
        return Vector3d(x, y, next());
    };
    const auto next_entry = [&] {
        LoadEntry entry;
        entry.force = next_vector();
        entry.moment = next_vector();
        entry.turbulent_kinetic_energy = next();
        entry.dissipation_rate = next();
        return entry;
    };
    SolvedCase solved;
    solved.name = words[0];
    solved.purpose = purpose_of(words[1]);
    solved.mesh = words[2];
    solved.closure = closure_of(words[3]);
    solved.sample.direction = next_vector();
    solved.reynolds_number = next();
    solved.sample.entry = next_entry();
    solved.sample.error = next_entry();
    return solved;
}

}  // namespace

std::vector<SolvedCase> read_samples_csv(const std::filesystem::path& file) {
    std::istringstream lines(read_bytes(file));
    std::vector<SolvedCase> cases;
    int line_number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++line_number;
        if (line_number == 1) {
            if (line + '\n' == heading) continue;
            throw Error(
                fmt::format("{}:1: is not a table of cases; make one with 'samara convert CASES -o NAME.csv'",
                            file.string()));
        }
        try {
            cases.push_back(row_of(split(line)));
        } catch (const Error& error) {
            throw Error(fmt::format("{}:{}: {}", file.string(), line_number, error.what()));
        }
    }
    if (cases.empty())
        throw Error(fmt::format("{}: holds no case; make it again with 'samara convert CASES -o NAME.csv'",
                                file.string()));
    return cases;
}

std::string samples_csv(const std::vector<SolvedCase>& cases, const Matrix3d& axes) {
    std::string text = heading;
    for (const SolvedCase& solved : cases) {
        const auto& [direction, entry, error] = solved.sample;
        text += fmt::format("{},{},{},{},{},{},{},{}\n", quoted(solved.name), name_of(solved.purpose),
                            quoted(solved.mesh), name_of(solved.closure), columns(Vector3d(axes * direction)),
                            solved.reynolds_number, columns(transformed(entry, axes)),
                            columns(transformed_error(error, axes)));
    }
    return text;
}

}  // namespace samara
