#include "converter/openfoam/foam_dictionary.hpp"

#include <charconv>
#include <utility>

#include <fmt/format.h>

#include "converter/openfoam/foam_scanner.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

std::string_view trimmed(std::string_view text) {
    const std::size_t start = text.find_first_not_of(" \t\r\n");
    return start == std::string_view::npos ? std::string_view() : text.substr(start);
}

/// Takes a number off the front of the text.
std::optional<double> take_number(std::string_view& text) {
    text = trimmed(text);
    double value = 0.0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (status != std::errc()) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

// The deepest nesting of dictionaries, far beyond that of any case.
constexpr int deepest = 100;

}  // namespace

FoamDictionary::FoamDictionary(const std::filesystem::path& file) : path_(file) {
    FoamScanner scanner(file);
    read(scanner, 0);
}

FoamDictionary::FoamDictionary(std::filesystem::path path, FoamScanner& scanner, int depth)
    : path_(std::move(path)) {
    read(scanner, depth);
}

void FoamDictionary::read(FoamScanner& scanner, int depth) {
    if (depth > deepest) throw scanner.error("dictionaries are nested too deep");
    while (depth > 0 ? !scanner.accept('}') : !scanner.at_end()) {
        const std::string name(scanner.word());
        if (name.starts_with('#')) {
            const std::string_view file = scanner.word();
            if (name == "#include" || name == "#includeIfPresent") included_.emplace_back(file);
        } else if (scanner.accept('{')) {
            dictionaries_.insert_or_assign(name, FoamDictionary(path_, scanner, depth + 1));
        } else {
            entries_[name] = scanner.text_before(';');
        }
    }
}

std::string FoamDictionary::place_of(const std::string& name) const {
    return fmt::format("{}: entry '{}'", path_.string(), name);
}

const std::string& FoamDictionary::text(const std::string& name) const {
    const auto found = entries_.find(name);
    if (found == entries_.end()) throw Error(place_of(name) + " is missing");
    return found->second;
}

double FoamDictionary::number(const std::string& name) const {
    std::string_view rest = text(name);
    const std::optional<double> value = take_number(rest);
    if (!value || !trimmed(rest).empty()) {
        throw Error(fmt::format("{} should be a number, is '{}'", place_of(name), text(name)));
    }
    return *value;
}

Vector3d FoamDictionary::vector(const std::string& name) const {
    const std::optional<Vector3d> values = foam_vector(text(name));
    if (values) return *values;
    throw Error(fmt::format("{} should be three numbers in brackets, is '{}'", place_of(name), text(name)));
}

std::optional<Vector3d> foam_vector(std::string_view text) {
    if (!text.starts_with('(') || !text.ends_with(')')) return std::nullopt;
    text = text.substr(1, text.size() - 2);
    Vector3d values;
    for (double& value : values) {
        const std::optional<double> next = take_number(text);
        if (!next) return std::nullopt;
        value = *next;
    }
    return trimmed(text).empty() ? std::optional(values) : std::nullopt;
}

}  // namespace samara
