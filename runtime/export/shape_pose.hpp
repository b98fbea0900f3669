#pragma once

#include <vector>

#include "samara/motion/motion.hpp"

namespace samara {

/// The place and motion of the shape file's origin and axes, which is what other programs move: they know the
/// shape and not its centre of mass.
struct ShapePose {
    Vector3d position = Vector3d::Zero();               ///< of the shape file's origin (m, world)
    Quaterniond orientation = Quaterniond::Identity();  ///< shape to world axes, unit length
    Vector3d velocity = Vector3d::Zero();               ///< of the shape file's origin (m/s, world)
    Vector3d angular_velocity = Vector3d::Zero();       ///< rad/s, world axes
};

/// One copy in one run, a pose for each frame. The quaternions' signs are continuous: each has a product >= 0
/// with the one before it. The first keeps its sign.
std::vector<ShapePose> shape_poses(const Motion& motion, const BodyMotion& body, int run, int copy);

/// Where an obstacle is at each frame, in the same way; without velocities.
std::vector<ShapePose> shape_poses(const Motion& motion, const Obstacle& obstacle);

/// What a copy is called in other programs: NAME for the first one, then NAME.001, NAME.002 and so on.
std::string copy_name(const BodyMotion& body, int copy);

}  // namespace samara
