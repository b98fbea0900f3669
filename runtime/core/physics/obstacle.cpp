#include "samara/core/physics/obstacle.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
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

void require_steady_keys(const Obstacle& obstacle) {
    double reach = 0.0;
    for (const Vector3d& vertex : obstacle.surface.vertices) reach = std::max(reach, vertex.norm());
    const auto& keys = obstacle.keys;
    for (std::size_t i = 1; i < keys.size(); ++i) {
        const ObstacleMotion motion = motion_between(keys[i - 1], keys[i]);
        const double fastest = motion.velocity.norm() + reach * motion.angular_velocity.norm();
        if (fastest <= most_key_speed) continue;
        throw Error(
            fmt::format("jump: from {:g} s to {:g} s the mesh moves at {:.3g} m/s, and {:g} is the most; put "
                        "them farther apart in time",
                        keys[i - 1].time, keys[i].time, fastest, most_key_speed));
    }
}

}  // namespace samara
