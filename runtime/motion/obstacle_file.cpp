#include "samara/motion/obstacle_file.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/body/file_arrays.hpp"

namespace samara {
namespace {

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
            throw Error(
                fmt::format("{}: {} is no obstacle; simulate the scene again", file.path().string(), group));
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
