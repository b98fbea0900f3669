#include "samara/motion/display_group.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/body/file_arrays.hpp"
#include "samara/core/surface/display_image.hpp"

namespace samara {
namespace {

/// One in each line; a line's end within a name becomes a blank.
template <typename Named>
std::string names_of(const std::vector<Named>& parts) {
    std::string names;
    for (const Named& part : parts) {
        std::string name = part.name;
        std::replace(name.begin(), name.end(), '\n', ' ');
        names += name + '\n';
    }
    return names;
}

/// Takes the first line of names.
std::string next_name(std::string& names) {
    const std::size_t end = std::min(names.find('\n'), names.size());
    std::string name = names.substr(0, end);
    names.erase(0, end + 1);
    return name;
}

void write_images(Hdf5Writer& file, const std::string& group, const DisplayMesh& display) {
    std::vector<std::int32_t> numbers;
    for (const DisplayMaterial& material : display.materials) {
        numbers.push_back(material.image);
        numbers.push_back(static_cast<std::int32_t>(material.transparency));
    }
    file.write(group + "/painting", numbers, {display.materials.size(), 2}, "1",
               "of each material its image, -1: none, and 0: opaque, 1: cut out, 2: blended");
    if (display.images.empty()) return;
    file.write_text(group + "/image_names", names_of(display.images), "one in each line");
    for (std::size_t i = 0; i < display.images.size(); ++i) {
        file.write_text(fmt::format("{}/image_{}", group, i), display.images[i].bytes, "a PNG or JPEG file");
    }
}

/// What files of earlier versions do not have stays as it is.
void read_images(const Hdf5Reader& file, const std::string& group, DisplayMesh& display) {
    if (!file.has(group + "/painting")) return;
    const std::vector<std::int32_t> numbers =
        file.integers(group + "/painting", {display.materials.size(), 2});
    if (file.has(group + "/image_names")) {
        std::string names = file.text(group + "/image_names");
        for (std::size_t i = 0; file.has(fmt::format("{}/image_{}", group, i)); ++i) {
            display.images.push_back({next_name(names), file.text(fmt::format("{}/image_{}", group, i))});
        }
    }
    for (std::size_t i = 0; i < display.materials.size(); ++i) {
        display.materials[i].image = numbers[2 * i];
        display.materials[i].transparency =
            static_cast<DisplayTransparency>(std::clamp(numbers[2 * i + 1], 0, 2));
    }
}

bool are_images_sound(const DisplayMesh& display) {
    const auto images = static_cast<std::int32_t>(display.images.size());
    return std::all_of(display.images.begin(), display.images.end(),
                       [](const DisplayImage& image) { return image_type(image.bytes) != nullptr; }) &&
           std::all_of(display.materials.begin(), display.materials.end(),
                       [&](const DisplayMaterial& material) {
                           return material.image >= -1 && material.image < images;
                       });
}

}  // namespace

void write_display(Hdf5Writer& file, const std::string& group, const DisplayMesh& display) {
    Surface triangles;
    triangles.vertices = display.positions;
    triangles.corners = display.corners;
    write_surface(file, group, triangles);
    if (!display.normals.empty()) {
        file.write(group + "/normals", flattened(display.normals), {display.normals.size(), 3}, "1",
                   "shape axes");
    }
    std::vector<double> numbers;
    for (const Eigen::Vector2d& place : display.texture)
        numbers.insert(numbers.end(), place.begin(), place.end());
    if (!numbers.empty()) {
        file.write(group + "/texture", numbers, {display.texture.size(), 2}, "1",
                   "u to the right, v upwards");
    }
    file.write(group + "/slots", display.slots, {display.slots.size()}, "1", "of each triangle its material");
    numbers.clear();
    for (const DisplayMaterial& material : display.materials) {
        numbers.insert(numbers.end(), material.color.begin(), material.color.end());
    }
    file.write(group + "/colors", numbers, {display.materials.size(), 4}, "1",
               "of each material: red, green, blue, opacity");
    file.write_text(group + "/materials", names_of(display.materials), "their names, one in each line");
    write_images(file, group, display);
}

std::shared_ptr<const DisplayMesh> read_display(const Hdf5Reader& file, const std::string& group) {
    if (!file.has(group)) return nullptr;
    DisplayMesh display;
    Surface triangles = read_surface(file, group);
    display.positions = std::move(triangles.vertices);
    display.corners = std::move(triangles.corners);
    const std::size_t count = display.positions.size();
    if (file.has(group + "/normals"))
        display.normals = unflattened(file.finite_doubles(group + "/normals", {count, 3}));
    if (file.has(group + "/texture")) {
        const std::vector<double> numbers = file.finite_doubles(group + "/texture", {count, 2});
        for (std::size_t i = 0; i < numbers.size(); i += 2)
            display.texture.emplace_back(numbers[i], numbers[i + 1]);
    }
    display.slots = file.integers(group + "/slots", {display.corners.size()});
    const std::vector<double> colors = file.finite_doubles(group + "/colors", {0, 4});
    std::string names = file.text(group + "/materials");
    for (std::size_t i = 0; i < colors.size(); i += 4) {
        DisplayMaterial& material = display.materials.emplace_back();
        for (std::size_t k = 0; k < 4; ++k) material.color[k] = std::clamp(colors[i + k], 0.0, 1.0);
        material.name = next_name(names);
    }
    read_images(file, group, display);
    const auto materials = static_cast<std::int32_t>(display.materials.size());
    const bool are_slots = std::all_of(display.slots.begin(), display.slots.end(),
                                       [&](std::int32_t slot) { return slot >= 0 && slot < materials; });
    if (display.corners.empty() || !are_slots || !are_images_sound(display)) {
        throw Error(fmt::format("{}: {} is no mesh; simulate the scene again", file.path().string(), group));
    }
    return std::make_shared<const DisplayMesh>(std::move(display));
}

}  // namespace samara
