#include "samara/motion/motion_layout.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/body/file_arrays.hpp"
#include "samara/core/surface/display_image.hpp"

namespace samara {
namespace {

constexpr double unit_length_tolerance = 1e-6;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
    throw Error(fmt::format("{}: {}; simulate the scene again", file.string(), what));
}

bool is_one(double length) {
    return std::abs(length - 1.0) <= unit_length_tolerance;
}

bool is_link_name(const std::string& name) {
    return !name.empty() && name.front() != '.' && name.find('/') == std::string::npos;
}

std::string place(const std::string& body, const char* what) {
    return fmt::format("/bodies/{} {}", body, what);
}

void check_times(const std::filesystem::path& file, const std::vector<double>& times) {
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (!std::isfinite(times[i])) fail(file, fmt::format("/time row {} is not finite", i));
        if (i > 0 && times[i] <= times[i - 1]) fail(file, fmt::format("/time does not ascend at row {}", i));
    }
}

void check_body(const std::filesystem::path& file, const BodyMotion& body, int runs) {
    if (body.copies < 1) fail(file, place(body.name, "has no copy"));
    const auto all = static_cast<std::size_t>(runs) * static_cast<std::size_t>(body.copies);
    if (!body.sizes.empty() && body.sizes.size() != all) {
        fail(file, place(body.name, "does not have one size for each run and copy"));
    }
    for (const double size : body.sizes) {
        if (!(size > 0.0) || !std::isfinite(size)) {
            fail(file, place(body.name, "has a size that is not a positive number"));
        }
    }
    if (body.surface.corners.empty()) fail(file, place(body.name, "has a surface without triangles"));
    if (!body.center_of_mass.allFinite())
        fail(file, place(body.name, "has a centre of mass that is not finite"));
    if (!is_one(body.shortest_axis.norm()))
        fail(file, place(body.name, "has a shortest_axis that is not a unit vector"));
    std::set<std::pair<std::string, std::string>> known;
    for (const MetricUncertainty& one : body.uncertainties) {
        if (!is_link_name(one.cause) || !is_link_name(one.metric) ||
            !known.emplace(one.cause, one.metric).second) {
            fail(file, place(body.name, "has a duplicate or unnamed uncertainty"));
        }
        if (!(one.relative >= 0.0 && one.chance >= 0.0) || !std::isfinite(one.relative + one.chance)) {
            fail(file, place(body.name, "has an uncertainty that is negative or not finite"));
        }
    }
}

/// Returns the names of parts, one in each line; a line's end within a name becomes a blank.
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

/// Reads the images of a display mesh; files of earlier versions have none.
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

constexpr std::size_t numbers_of_key = 8;

std::vector<ObstacleKey> keys_of(const std::vector<double>& numbers) {
    std::vector<ObstacleKey> keys;
    for (std::size_t i = 0; i < numbers.size(); i += numbers_of_key) {
        const double* key = &numbers[i];
        keys.push_back({{Vector3d(key + 1), Quaterniond(key[4], key[5], key[6], key[7])}, key[0]});
    }
    return keys;
}

bool are_sound(const std::vector<ObstacleKey>& keys) {
    const auto not_later = [](const ObstacleKey& a, const ObstacleKey& b) { return a.time >= b.time; };
    return !keys.empty() && std::adjacent_find(keys.begin(), keys.end(), not_later) == keys.end() &&
           std::all_of(keys.begin(), keys.end(),
                       [](const ObstacleKey& key) { return std::abs(key.orientation.norm() - 1.0) <= 1e-6; });
}

}  // namespace

std::string forces_of(const std::string& body, const std::string& part) {
    return "/bodies/" + body + "/forces/" + part;
}

std::string uncertainty_group(const std::string& body) {
    return "/bodies/" + body + "/uncertainty";
}

void check_motion_but_poses(const std::filesystem::path& file, const Motion& motion) {
    if (motion.times.empty()) fail(file, "/time has no frames");
    if (motion.runs < 1) fail(file, "it has no runs");
    if (motion.bodies.empty()) fail(file, "it has no bodies");
    if (!(motion.frame_rate > 0.0) || !std::isfinite(motion.frame_rate)) {
        fail(file, "frame_rate is not a positive number");
    }
    if (!motion.gravity.allFinite()) fail(file, "/gravity holds a value that is not finite");
    if (motion.ground && !std::isfinite(*motion.ground)) fail(file, "ground is not finite");
    check_times(file, motion.times);
    std::set<std::string> names;
    for (const BodyMotion& body : motion.bodies) {
        if (!is_link_name(body.name)) {
            fail(file, fmt::format("the body's name '{}' is empty, starts with a dot or contains a slash",
                                   body.name));
        }
        if (!names.insert(body.name).second)
            fail(file, fmt::format("two bodies have the name {}", body.name));
        check_body(file, body, motion.runs);
    }
}

void check_poses(const std::filesystem::path& file, const std::string& body, const std::vector<Pose>& poses) {
    for (const Pose& pose : poses) {
        if (!pose.position.allFinite() || !pose.velocity.allFinite() || !pose.angular_velocity.allFinite()) {
            fail(file, place(body, "has a pose with a value that is not finite"));
        }
        if (!is_one(pose.orientation.norm()))
            fail(file, place(body, "has an orientation that is not of unit length"));
    }
}

void check_motion(const std::filesystem::path& file, const Motion& motion) {
    check_motion_but_poses(file, motion);
    const std::size_t rows = static_cast<std::size_t>(motion.runs) * motion.times.size();
    for (const BodyMotion& body : motion.bodies) {
        if (body.poses.size() != rows * static_cast<std::size_t>(body.copies)) {
            fail(file, place(body.name, "does not have one pose for each run, frame and copy"));
        }
        check_poses(file, body.name, body.poses);
    }
}

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
        throw Error(
            fmt::format("{}: {} is not a mesh; simulate the scene again", file.path().string(), group));
    }
    return std::make_shared<const DisplayMesh>(std::move(display));
}

void write_obstacles(Hdf5Writer& file, const std::vector<Obstacle>& obstacles) {
    for (std::size_t i = 0; i < obstacles.size(); ++i) {
        const Obstacle& obstacle = obstacles[i];
        const std::string group = "/obstacles/" + obstacle.name;
        std::vector<double> numbers;
        for (const ObstacleKey& key : obstacle.keys) {
            const Quaterniond& q = key.orientation;
            numbers.push_back(key.time);
            numbers.insert(numbers.end(), key.position.begin(), key.position.end());
            numbers.insert(numbers.end(), {q.w(), q.x(), q.y(), q.z()});
        }
        file.write(
            group + "/keys", numbers, {obstacle.keys.size(), numbers_of_key}, "1",
            "time (s), place of the shape's origin (m, world), unit quaternion w, x, y, z, shape to world");
        write_surface(file, group + "/surface", obstacle.surface);
        file.attribute(group, "friction", obstacle.friction);
        file.attribute(group, "index", static_cast<std::int64_t>(i));
    }
}

std::vector<Obstacle> read_obstacles(const Hdf5Reader& file) {
    std::vector<std::pair<std::int64_t, Obstacle>> found;
    if (!file.has("/obstacles")) return {};
    for (const std::string& name : file.children("/obstacles")) {
        const std::string group = "/obstacles/" + name;
        Obstacle obstacle;
        obstacle.name = name;
        obstacle.surface = read_surface(file, group + "/surface");
        obstacle.friction = file.number_attribute(group, "friction");
        obstacle.keys = keys_of(file.finite_doubles(group + "/keys", {0, numbers_of_key}));
        if (!are_sound(obstacle.keys) || !(obstacle.friction >= 0.0) || obstacle.surface.corners.empty()) {
            throw Error(fmt::format("{}: {} is not an obstacle; simulate the scene again",
                                    file.path().string(), group));
        }
        found.emplace_back(file.integer_attribute(group, "index"), std::move(obstacle));
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<Obstacle> obstacles;
    for (auto& [index, obstacle] : found) obstacles.push_back(std::move(obstacle));
    return obstacles;
}

}  // namespace samara
