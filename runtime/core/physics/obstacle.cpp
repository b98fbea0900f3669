#include "samara/core/physics/obstacle.hpp"

#include <algorithm>

#include "samara/core/physics/obstacle_motion.hpp"

namespace samara {
namespace {

ObstacleMotion motion_between(const ObstacleKey& before, const ObstacleKey& after) {
    const double duration = after.time - before.time;
    Quaterniond rotation = after.orientation * before.orientation.conjugate();
    if (rotation.w() < 0.0) rotation.coeffs() = -rotation.coeffs();
    const Eigen::AngleAxisd about(rotation);
    return {(after.position - before.position) / duration, (about.angle() / duration) * about.axis()};
}

}  // namespace

ObstaclePlace place_of(const Obstacle& obstacle, double time) noexcept {
    const auto& keys = obstacle.keys;
    const auto after = std::upper_bound(keys.begin(), keys.end(), time,
                                        [](double at, const ObstacleKey& key) { return at < key.time; });
    if (after == keys.begin()) return keys.front();
    if (after == keys.end()) return keys.back();
    const ObstacleKey& before = *std::prev(after);
    const double share = (time - before.time) / (after->time - before.time);
    return {.position = before.position + share * (after->position - before.position),
            .orientation = before.orientation.slerp(share, after->orientation)};
}

ObstacleMotion motion_of(const Obstacle& obstacle, double time) {
    const auto& keys = obstacle.keys;
    const auto after = std::upper_bound(keys.begin(), keys.end(), time,
                                        [](double at, const ObstacleKey& key) { return at < key.time; });
    if (after == keys.begin() || after == keys.end()) return {};
    return motion_between(*std::prev(after), *after);
}

}  // namespace samara
