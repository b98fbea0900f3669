#pragma once

#include <vector>

#include "samara/motion/motion.hpp"

namespace samara {

/// Pose and velocities of the shape file's origin and axes, which other programs animate: they do not know
/// the centre of mass.
struct ShapePose {
    Vector3d position = Vector3d::Zero();               ///< position of the shape file's origin (m, world)
    Quaterniond orientation = Quaterniond::Identity();  ///< shape to world axes, unit length
    Vector3d velocity = Vector3d::Zero();               ///< velocity of the shape file's origin (m/s, world)
    Vector3d angular_velocity = Vector3d::Zero();       ///< rad/s, world axes
};

/// Returns the poses of one copy in one run, one for each frame. The quaternions' signs are continuous: each
/// has a product >= 0 with the one before it. The first keeps its sign.
std::vector<ShapePose> shape_poses(const Motion& motion, const BodyMotion& body, int run, int copy);

/// Returns the poses of an obstacle, one for each frame, with continuous signs of the quaternions and
/// without velocities.
std::vector<ShapePose> shape_poses(const Motion& motion, const Obstacle& obstacle);

/// Returns the name of a copy in other programs: NAME for the first one, then NAME.001, NAME.002 and so on.
std::string copy_name(const BodyMotion& body, int copy);

}  // namespace samara
