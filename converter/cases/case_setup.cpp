#include "converter/cases/case_setup.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <string_view>
#include <utility>

#include "converter/openfoam/foam_bytes.hpp"
#include "converter/openfoam/foam_dictionary.hpp"
#include "converter/openfoam/poly_mesh.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

// Names that stand for names, files that include files.
constexpr int most_steps = 4;

/// The dictionary in the file; nothing where there is none, or it cannot be read.
std::optional<FoamDictionary> dictionary_in(const fs::path& file) {
    if (!foam_file_exists(file)) return std::nullopt;
    try {
        return FoamDictionary(file);
    } catch (const Error&) {
        return std::nullopt;
    }
}

/// A dictionary and what its includes bring, the nearest first.
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

/// `folder`: of the case, out of which nothing is included.
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

/// The last word of a value, or its brackets, with a $name replaced by what it stands for; nothing where that
/// is said nowhere.
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
            const auto kind = entry_of(scopes, model);
            if (kind && *kind != "Newtonian" && *kind != "constant") return std::nullopt;
        }
        return number_in(scopes, "nu");
    }
    return std::nullopt;
}

/// The vector of "uniform (x y z)" or "uniform $name"; nothing of another value.
std::optional<Vector3d> uniform_in(const std::string& text, const Scopes& scopes) {
    if (!text.starts_with("uniform") && !text.starts_with('$')) return std::nullopt;
    const std::size_t start = text.starts_with('$') ? 0 : text.find_first_not_of(" \t\n", 7);
    if (start == std::string::npos) return std::nullopt;
    const auto value = plain_value(text.substr(start), scopes);
    return value ? foam_vector(*value) : std::nullopt;
}

/// What the patches of a velocity say of the flow that they let in: all the same, or nothing is known.
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

/// The words of "(a b)" or "a", without quotes.
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

bool is_word(const std::string& name) {
    return name.find_first_of("*+?[]{}|^$\\\\()") == std::string::npos;
}

}  // namespace

CaseSetup read_case_setup(const fs::path& folder) {
    CaseSetup setup;
    setup.viscosity = viscosity_of(folder);
    setup.flow = flow_of(folder);
    take_forces(folder, setup);
    return setup;
}

std::optional<double> area_of_patches(const fs::path& poly_mesh, const std::vector<std::string>& patches) {
    for (const char* name : {"points", "faces", "owner", "neighbour", "boundary"}) {
        if (!foam_file_exists(poly_mesh / name)) return std::nullopt;
    }
    const PolyMesh mesh = read_poly_mesh(poly_mesh);
    double area = 0.0;
    for (const std::string& pattern : patches) {
        const bool is_start = pattern.ends_with(".*");
        const std::string start = is_start ? pattern.substr(0, pattern.size() - 2) : pattern;
        if (!is_word(start)) return std::nullopt;
        for (const FoamPatch& patch : mesh.patches) {
            if (is_start ? !patch.name.starts_with(start) : patch.name != start) continue;
            for (std::size_t i = 0; i < patch.size; ++i) {
                area += face_geometry(mesh.corners(patch.start + i)).area.norm();
            }
        }
    }
    return area > 0.0 ? std::optional(area) : std::nullopt;
}

}  // namespace samara
