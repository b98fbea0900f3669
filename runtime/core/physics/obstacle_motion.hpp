#pragma once

#include "samara/core/physics/obstacle.hpp"

namespace samara {

/// The velocity of an obstacle at a time: it rotates about its shape file's origin and moves with it.
struct ObstacleMotion {
    Vector3d velocity = Vector3d::Zero();          ///< of the shape file's origin, m/s, world
    Vector3d angular_velocity = Vector3d::Zero();  ///< rad/s, world
};

/// Returns the velocity of an obstacle at a time (s, of the world); zero before the first key and from the
/// last on.
ObstacleMotion motion_of(const Obstacle& obstacle, double time);

/// The most speed (m/s) of a point of an obstacle between two keys; beyond it the keys jump.
inline constexpr double most_key_speed = 100.0;

}  // namespace samara
