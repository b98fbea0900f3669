#include "converter/cases/case_checks.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "converter/openfoam/foam_dictionary.hpp"
#include "converter/openfoam/foam_scanner.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

// The depth to which names that refer to names, and files that include files, are followed.
constexpr int most_steps = 4;

/// Reads the dictionary in the file; nothing where there is none, or it cannot be read.
std::optional<FoamDictionary> dictionary_in(const fs::path& file) {
    if (!foam_file_exists(file)) return std::nullopt;
    try {
        return FoamDictionary(file);
    } catch (const Error&) {
        return std::nullopt;
    }
}

/// A dictionary and those that it includes, the nearest first.
using Scopes = std::vector<FoamDictionary>;

bool is_within(const fs::path& file, const fs::path& folder) {
    const fs::path inside = file.lexically_normal().lexically_relative(folder.lexically_normal());
    return !inside.empty() && *inside.begin() != "..";
}

void add_included(const FoamDictionary& dictionary, const fs::path& folder, int steps, Scopes& scopes) {
    for (const std::string& name : dictionary.included()) {
        const fs::path file = dictionary.file().parent_path() / name;
        const auto included = is_within(file, folder) ? dictionary_in(file) : std::nullopt;
        if (!included) continue;
        scopes.push_back(*included);
        if (steps > 1) add_included(*included, folder, steps - 1, scopes);
    }
}

/// Returns the scopes of a dictionary. `folder`: the case's, out of which nothing is included.
Scopes scopes_of(const FoamDictionary& dictionary, const fs::path& folder) {
    Scopes scopes = {dictionary};
    add_included(dictionary, folder, most_steps, scopes);
    return scopes;
}

std::optional<std::string> entry_of(const Scopes& scopes, const std::string& name) {
    for (const FoamDictionary& scope : scopes) {
        if (scope.has(name)) return scope.text(name);
    }
    return std::nullopt;
}

/// Returns the last word of a value, or its brackets, with a $name replaced by its value; nothing where that
/// is not defined.
std::optional<std::string> plain_value(std::string text, const Scopes& scopes) {
    for (int step = 0; step < most_steps; ++step) {
        if (!text.ends_with(')')) text = text.substr(text.find_last_of(" \t\n") + 1);
        if (!text.starts_with('$')) return text;
        const auto named = entry_of(scopes, text.substr(1));
        if (!named) return std::nullopt;
        text = *named;
        if (text.starts_with("uniform")) text = text.substr(text.find_first_not_of(" \t\n", 7));
    }
    return std::nullopt;
}

std::optional<double> number_in(const Scopes& scopes, const std::string& name) {
    const auto entry = entry_of(scopes, name);
    const auto text = entry ? plain_value(*entry, scopes) : std::nullopt;
    if (!text) return std::nullopt;
    double value = 0.0;
    const auto [end, status] = std::from_chars(text->data(), text->data() + text->size(), value);
    if (status != std::errc() || end != text->data() + text->size()) return std::nullopt;
    return value;
}

std::optional<double> viscosity_of(const fs::path& folder) {
    for (const char* name : {"transportProperties", "physicalProperties"}) {
        const auto properties = dictionary_in(folder / "constant" / name);
        if (!properties) continue;
        const Scopes scopes = scopes_of(*properties, folder);
        for (const char* model : {"transportModel", "viscosityModel"}) {
            const auto type = entry_of(scopes, model);
            if (type && *type != "Newtonian" && *type != "constant") return std::nullopt;
        }
        return number_in(scopes, "nu");
    }
    return std::nullopt;
}

/// Returns the vector of "uniform (x y z)" or "uniform $name"; nothing for another value.
std::optional<Vector3d> uniform_in(const std::string& text, const Scopes& scopes) {
    if (!text.starts_with("uniform") && !text.starts_with('$')) return std::nullopt;
    const std::size_t start = text.starts_with('$') ? 0 : text.find_first_not_of(" \t\n", 7);
    if (start == std::string::npos) return std::nullopt;
    const auto value = plain_value(text.substr(start), scopes);
    return value ? foam_vector(*value) : std::nullopt;
}

/// Returns the velocity of the flow that the patches prescribe; nothing where they prescribe none, or
/// different ones.
std::optional<Vector3d> flow_in(const FoamDictionary& velocity, const fs::path& folder) {
    const auto boundary = velocity.dictionaries().find("boundaryField");
    if (boundary == velocity.dictionaries().end()) return std::nullopt;
    std::optional<Vector3d> flow;
    for (const auto& [name, patch] : boundary->second.dictionaries()) {
        Scopes scopes = {patch};
        for (const FoamDictionary& outer : scopes_of(velocity, folder)) scopes.push_back(outer);
        for (const char* entry : {"freestreamValue", "inletValue", "value"}) {
            if (!patch.has(entry)) continue;
            const auto value = uniform_in(patch.text(entry), scopes);
            if (!value || value->norm() == 0.0) continue;
            if (flow && (*flow - *value).norm() > 1e-6 * flow->norm()) return std::nullopt;
            flow = value;
        }
    }
    return flow;
}

std::optional<Vector3d> flow_of(const fs::path& folder) {
    for (const char* name : {"0/U", "0.orig/U", "processor0/0/U"}) {
        if (const auto velocity = dictionary_in(folder / name)) return flow_in(*velocity, folder);
    }
    return std::nullopt;
}

/// Returns the words of "(a b)" or "a", without quotes.
std::vector<std::string> words_of(std::string text) {
    std::erase_if(text, [](char c) { return c == '(' || c == ')' || c == '"'; });
    std::istringstream stream(text);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

void take_forces(const fs::path& folder, CaseSetup& setup) {
    const auto control = dictionary_in(folder / "system/controlDict");
    if (!control) return;
    const auto functions = control->dictionaries().find("functions");
    if (functions == control->dictionaries().end()) return;
    const Scopes outer = scopes_of(*control, folder);
    for (const FoamDictionary& scope : scopes_of(functions->second, folder)) {
        for (const auto& [name, object] : scope.dictionaries()) {
            if (!object.has("type") || object.text("type") != "forces") continue;
            Scopes scopes = scopes_of(object, folder);
            scopes.insert(scopes.end(), outer.begin(), outer.end());
            if (object.has("patches")) setup.patches = words_of(object.text("patches"));
            if (object.has("rho") && object.text("rho") != "rhoInf") return;
            setup.density = number_in(scopes, "rhoInf");
            return;
        }
    }
}

}  // namespace

CaseSetup read_case_setup(const fs::path& folder) {
    CaseSetup setup;
    setup.viscosity = viscosity_of(folder);
    setup.flow = flow_of(folder);
    take_forces(folder, setup);
    return setup;
}

namespace {

// A value this far from the median is no part of a settled flow, but of a damaged file or a diverging solver.
// The limits were chosen far beyond any oscillation of a wake.
constexpr double most_over_median = 10.0;
constexpr double most_over_scatter = 50.0;

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

std::size_t first_index(const QuantityHistory& history, double start) {
    const auto first = std::lower_bound(history.times.begin(), history.times.end(), start);
    return static_cast<std::size_t>(first - history.times.begin());
}

bool same_time(double a, double b) {
    return std::abs(a - b) <= 1e-6 * std::abs(b);
}

// Throws where `history` lacks one of the times of `other`.
void require_times_of(const QuantityHistory& other, const QuantityHistory& history, double start,
                      const std::string& remedy) {
    std::size_t i = first_index(history, start);
    for (std::size_t j = first_index(other, start); j < other.times.size(); ++j, ++i) {
        const double time = other.times[j];
        if (i < history.times.size() && same_time(history.times[i], time)) continue;
        // A history that is ahead lacks the time; one that is behind has times that the other lacks, which
        // the call with the two exchanged reports.
        if (i < history.times.size() && history.times[i] < time) return;
        throw Error(fmt::format(
            "{}: has no {} at the time {:.10g}, but {} has one: it was emptied or truncated, or its run's "
            "file is missing; {}",
            history.files.at(time).string(), history.name, time, other.files.at(time).string(), remedy));
    }
}

void require_even_steps(const QuantityHistory& history, double start, const std::string& remedy) {
    const std::size_t first = first_index(history, start);
    std::vector<double> steps;
    for (std::size_t i = first + 1; i < history.times.size(); ++i) {
        steps.push_back(history.times[i] - history.times[i - 1]);
    }
    const double usual = median(steps);
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (steps[i] <= 2.0 * usual * (1.0 + 1e-6)) continue;
        const double before = history.times[first + i];
        throw Error(fmt::format(
            "{}: has nothing between the times {:.10g} and {:.10g}; a run's file was emptied or is "
            "missing; {}",
            history.files.at(before).string(), before, before + steps[i], remedy));
    }
}

}  // namespace

void require_whole(const std::vector<QuantityHistory>& histories, double start, const std::string& remedy) {
    for (const QuantityHistory& history : histories) {
        for (const QuantityHistory& other : histories) require_times_of(other, history, start, remedy);
    }
    if (!histories.empty()) require_even_steps(histories.front(), start, remedy);
}

void require_plausible(const QuantityHistory& history, double start, const std::string& remedy) {
    const std::size_t first = first_index(history, start);
    const auto reject = [&](std::size_t i, const std::string& why) {
        const double size = history.is_scalar ? history.values[i].x() : history.values[i].norm();
        throw Error(fmt::format("{}: the {} {} {:.4g} at the time {:.10g}, {}; {}",
                                history.files.at(history.times[i]).string(), history.name,
                                history.is_scalar ? "is" : "has the magnitude", size, history.times[i], why,
                                remedy));
    };
    Vector3d middle;
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> components;
        for (std::size_t i = first; i < history.values.size(); ++i)
            components.push_back(history.values[i][axis]);
        middle[axis] = median(std::move(components));
    }
    std::vector<double> distances;
    for (std::size_t i = first; i < history.values.size(); ++i) {
        distances.push_back((history.values[i] - middle).norm());
    }
    const double scatter = median(distances);
    const double most =
        most_over_median * std::max(middle.norm(), history.noise) + most_over_scatter * scatter;
    for (std::size_t i = first; i < history.values.size(); ++i) {
        if (history.values[i].norm() > history.largest) {
            reject(i, fmt::format("above the largest plausible value ({:.4g}): diverged or damaged",
                                  history.largest));
        }
        if (history.is_scalar && history.values[i].x() < 0.0)
            reject(i, "but cannot be negative: diverged or damaged");
        if (distances[i - first] > most) {
            reject(i, fmt::format("far from the others (about {:.4g}): damaged, or not converged",
                                  history.is_scalar ? middle.x() : middle.norm()));
        }
    }
}

}  // namespace samara
