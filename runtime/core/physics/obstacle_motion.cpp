#include "samara/core/physics/obstacle_motion.hpp"

#include <algorithm>

namespace samara {
namespace {

ObstacleMotion motion_between(const ObstacleKey& before, const ObstacleKey& after) {
    const double duration = after.time - before.time;
    Quaterniond turn = after.orientation * before.orientation.conjugate();
    if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
    const Eigen::AngleAxisd about(turn);
    return {(after.position - before.position) / duration, (about.angle() / duration) * about.axis()};
}

}  // namespace

ObstacleMotion motion_of(const Obstacle& obstacle, double time) {
    const auto& keys = obstacle.keys;
    const auto after = std::upper_bound(keys.begin(), keys.end(), time,
                                        [](double at, const ObstacleKey& key) { return at < key.time; });
    if (after == keys.begin() || after == keys.end()) return {};
    return motion_between(*std::prev(after), *after);
}

}  // namespace samara
