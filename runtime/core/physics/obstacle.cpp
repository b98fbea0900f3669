#include "samara/core/physics/obstacle.hpp"

#include <algorithm>

namespace samara {

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

}  // namespace samara
