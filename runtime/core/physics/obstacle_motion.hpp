#pragma once

#include "samara/core/physics/obstacle.hpp"

namespace samara {

/// How an obstacle moves at a time: all of it turns about its shape file's origin, and goes with that.
struct ObstacleMotion {
    Vector3d velocity = Vector3d::Zero();          ///< of the shape file's origin, m/s, world
    Vector3d angular_velocity = Vector3d::Zero();  ///< rad/s, world
};

/// Zero before the first key and from the last on.
ObstacleMotion motion_of(const Obstacle& obstacle, double time);

/// Keys between which a point of an obstacle moves faster than this jump (m/s).
inline constexpr double most_key_speed = 100.0;

}  // namespace samara
