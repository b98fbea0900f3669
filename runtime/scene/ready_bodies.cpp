#include "samara/scene/ready_bodies.hpp"

#include <cstdlib>
#include <map>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/folders.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/input_file.hpp"
#include "samara/formats/toml_table.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

using BodiesByName = std::map<std::string, ReadyBody>;

/// Reads name, fluid, density and purpose of each body from the index. `./dev bodies` reads the rest.
BodiesByName read_index(const fs::path& file) {
    const toml::table document = parse_toml(read_bytes(file), file.string());
    BodiesByName bodies;
    TomlTable top(document, file.string(), "the index");
    for (TomlTable& table : top.tables("body")) {
        const auto name = table.text("name");
        if (!name) throw table.error("name", "is missing; give the body a name");
        ReadyBody& body = bodies[*name];
        body.name = *name;
        body.fluid = table.text("fluid").value_or("");
        body.density = table.number("density", positive_number);
        body.purpose = table.text("purpose").value_or("");
        table.number("density_to", positive_number);
        table.number("fall_step", positive_number);
        table.number("area_density", positive_number);
        for (const char* key :
             {"shape", "quality", "falls", "mass", "center_of_mass", "inertia", "recommended"}) {
            table.text(key);
        }
        table.finish();
    }
    top.finish();
    return bodies;
}

constexpr const char* chosen_folder = "SAMARA_BODIES";

/// A file that is as it was when samara was built is part of it, and need not be read in a process of its own
/// first.
void trust_unchanged(const fs::path& file) {
    if (std::getenv(chosen_folder) != nullptr) return;
    const std::string digest = digest_in(InputFile(file));
    if (!digest.empty() && std::string_view(SAMARA_BODIES_DIGESTS).find(digest) != std::string_view::npos) {
        Hdf5Reader::trust(file);
    }
}

}  // namespace

fs::path ready_bodies_folder() {
    return find_share_folder({"bodies", "the ready-baked bodies", chosen_folder, "", SAMARA_BODIES_SOURCE});
}

std::vector<ReadyBody> ready_bodies(const fs::path& folder) {
    const fs::path index = folder / "bodies.toml";
    BodiesByName bodies = fs::exists(index) ? read_index(index) : BodiesByName();
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (is_body_file_name(entry.path())) bodies[body_name_of(entry.path())].exists = true;
    }
    std::vector<ReadyBody> result;
    for (auto& [name, body] : bodies) {
        body.name = name;
        body.file = folder / (name + ".body.h5");
        result.push_back(body);
    }
    return result;
}

fs::path ready_body_file(const std::string& name) {
    const fs::path folder = ready_bodies_folder();
    std::vector<std::string> names;
    for (const ReadyBody& body : ready_bodies(folder)) {
        if (!body.exists) continue;
        if (body.name == name) {
            trust_unchanged(body.file);
            return body.file;
        }
        names.push_back(body.name);
    }
    throw Error(fmt::format("there is no ready-baked body '{}' in {}; choose one of {}", name,
                            folder.string(), fmt::join(names, ", ")));
}

}  // namespace samara
