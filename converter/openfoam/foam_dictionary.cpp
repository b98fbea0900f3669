#include "converter/openfoam/foam_dictionary.hpp"

#include <charconv>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "converter/openfoam/foam_scanner.hpp"
#include "samara/base/error.hpp"

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

}  // namespace

FoamDictionary::FoamDictionary(const std::filesystem::path& file) : path_(file) {
    FoamScanner scanner(file);
    while (!scanner.at_end()) {
        const std::string name(scanner.word());
        if (name.starts_with('#')) {
            scanner.word();
        } else if (scanner.accept('{')) {
            scanner.text_before('}');
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
    const auto fault = [&] {
        return Error(
            fmt::format("{} should be three numbers in brackets, is '{}'", place_of(name), text(name)));
    };
    std::string_view rest = text(name);
    if (!rest.starts_with('(') || !rest.ends_with(')')) throw fault();
    rest = rest.substr(1, rest.size() - 2);
    Vector3d values;
    for (double& value : values) {
        const std::optional<double> next = take_number(rest);
        if (!next) throw fault();
        value = *next;
    }
    if (!trimmed(rest).empty()) throw fault();
    return values;
}

}  // namespace samara
