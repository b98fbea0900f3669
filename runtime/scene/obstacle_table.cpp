#include "samara/scene/obstacle_table.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "samara/core/base/text.hpp"
#include "samara/core/files/input_file.hpp"
#include "samara/core/surface/mended_surface.hpp"
#include "samara/core/surface/obj_file.hpp"
#include "samara/core/surface/stl_file.hpp"
#include "samara/core/surface/surface_check.hpp"
#include "samara/formats/display_mesh_file.hpp"
#include "samara/scene/require_rules.hpp"

namespace samara {
namespace {

std::string extension_of(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
    return extension;
}

Surface read_mesh(const TomlTable& table, const std::filesystem::path& file) {
    const std::string extension = extension_of(file);
    if (extension != ".stl" && extension != ".obj" && extension != ".glb") {
        throw table.error(
            "shape", fmt::format("must be a mesh, .stl, .obj or .glb, not '{}'", file.filename().string()));
    }
    if (const std::string error = reading_error(file); !error.empty()) {
        throw table.error("shape", fmt::format("cannot be read: {}: {}", file.string(), error));
    }
    try {
        Surface surface = mended(extension == ".stl"   ? read_stl_file(file)
                                 : extension == ".obj" ? read_obj_file(file)
                                                       : surface_of(read_display_mesh_file(file)));
        require_solid_surface(surface);
        return surface;
    } catch (const Error& error) {
        throw table.error("shape",
                          fmt::format("is not a valid surface: {}: {}", file.string(), error.what()));
    }
}

ObstaclePlace read_place(TomlTable& table, const ObstaclePlace& standard) {
    return {.position = table.vector("position").value_or(standard.position),
            .orientation = table.orientation().value_or(standard.orientation)};
}

std::vector<ObstacleKey> read_keys(TomlTable& table, const ObstaclePlace& place) {
    std::vector<ObstacleKey> keys;
    for (TomlTable& each : table.tables("keys")) {
        const auto time = each.number("time");
        if (!time) throw each.error("time", "is missing; give the time of the key in seconds");
        keys.push_back({read_place(each, place), *time});
        each.finish();
    }
    if (keys.empty()) keys.push_back({place, 0.0});
    return keys;
}

/// Reads shape, scale, position and keys of a solid.
void read_solid(TomlTable& table, const std::filesystem::path& folder, Obstacle& obstacle) {
    const auto shape = table.text("shape");
    if (!shape) throw table.error("shape", "is missing; give a mesh, .stl, .obj or .glb");
    obstacle.surface = read_mesh(table, folder / *shape);
    const double scale = table.number("scale", positive_number).value_or(1.0);
    for (Vector3d& vertex : obstacle.surface.vertices) vertex *= scale;
    obstacle.keys = read_keys(table, read_place(table, {}));
}

}  // namespace

Emitter read_emitter(TomlTable& table, const std::filesystem::path& folder) {
    Obstacle mesh;
    read_solid(table, folder, mesh);
    require_rules(table, broken_rule(mesh));
    const double offset = table.number("offset", non_negative_number).value_or(0.0);
    const double speed = table.number("speed").value_or(0.0);
    table.finish();
    return make_emitter(std::move(mesh), offset, speed);
}

Obstacle read_obstacle(TomlTable& table, const std::filesystem::path& folder) {
    Obstacle obstacle;
    const auto name = table.text("name");
    if (!name) throw table.error("name", "is missing; give the obstacle a name");
    if (!is_plain_name(*name)) throw table.error("name", plain_name_words);
    obstacle.name = *name;
    read_solid(table, folder, obstacle);
    obstacle.friction = table.number("friction").value_or(obstacle.friction);
    require_rules(table, broken_rule(obstacle));
    table.finish();
    return obstacle;
}

}  // namespace samara
