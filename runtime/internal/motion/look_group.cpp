#include "internal/motion/look_group.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "internal/body/surface_file.hpp"
#include "internal/files/row_major.hpp"
#include "samara/base/error.hpp"

namespace samara {
namespace {

/// One in each line; a line's end within a name becomes a blank.
std::string names_of(const LookMesh& look) {
    std::string names;
    for (const LookMaterial& material : look.materials) {
        std::string name = material.name;
        std::replace(name.begin(), name.end(), '\n', ' ');
        names += name + '\n';
    }
    return names;
}

}  // namespace

void write_look(Hdf5Writer& file, const std::string& group, const LookMesh& look) {
    Surface triangles;
    triangles.vertices = look.positions;
    triangles.corners = look.corners;
    write_surface(file, group, triangles);
    if (!look.normals.empty()) {
        file.write(group + "/normals", flattened(look.normals), {look.normals.size(), 3}, "1", "shape axes");
    }
    std::vector<double> numbers;
    for (const Eigen::Vector2d& place : look.texture)
        numbers.insert(numbers.end(), place.begin(), place.end());
    if (!numbers.empty()) {
        file.write(group + "/texture", numbers, {look.texture.size(), 2}, "1", "u to the right, v upwards");
    }
    file.write(group + "/slots", look.slots, {look.slots.size()}, "1", "of each triangle its material");
    numbers.clear();
    for (const LookMaterial& material : look.materials) {
        numbers.insert(numbers.end(), material.color.begin(), material.color.end());
    }
    file.write(group + "/colors", numbers, {look.materials.size(), 4}, "1",
               "of each material: red, green, blue, opacity");
    file.write_text(group + "/materials", names_of(look), "their names, one in each line");
}

std::shared_ptr<const LookMesh> read_look(const Hdf5Reader& file, const std::string& group) {
    if (!file.has(group)) return nullptr;
    LookMesh look;
    Surface triangles = read_surface(file, group);
    look.positions = std::move(triangles.vertices);
    look.corners = std::move(triangles.corners);
    const std::size_t count = look.positions.size();
    if (file.has(group + "/normals"))
        look.normals = unflattened(file.finite_doubles(group + "/normals", {count, 3}));
    if (file.has(group + "/texture")) {
        const std::vector<double> numbers = file.finite_doubles(group + "/texture", {count, 2});
        for (std::size_t i = 0; i < numbers.size(); i += 2)
            look.texture.emplace_back(numbers[i], numbers[i + 1]);
    }
    look.slots = file.integers(group + "/slots", {look.corners.size()});
    const std::vector<double> colors = file.finite_doubles(group + "/colors", {0, 4});
    const std::string names = file.text(group + "/materials");
    std::size_t place = 0;
    for (std::size_t i = 0; i < colors.size(); i += 4) {
        LookMaterial& material = look.materials.emplace_back();
        for (std::size_t k = 0; k < 4; ++k) material.color[k] = std::clamp(colors[i + k], 0.0, 1.0);
        const std::size_t end = std::min(names.find('\n', place), names.size());
        material.name = names.substr(std::min(place, names.size()), end - std::min(place, end));
        place = end + 1;
    }
    const auto materials = static_cast<std::int32_t>(look.materials.size());
    const bool are_slots = std::all_of(look.slots.begin(), look.slots.end(),
                                       [&](std::int32_t slot) { return slot >= 0 && slot < materials; });
    if (look.corners.empty() || !are_slots) {
        throw Error(fmt::format("{}: {} is no mesh; simulate the scene again", file.path().string(), group));
    }
    return std::make_shared<const LookMesh>(std::move(look));
}

}  // namespace samara
