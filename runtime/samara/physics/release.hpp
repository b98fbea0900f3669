#pragma once

#include "samara/base/linear_algebra.hpp"

namespace samara {

/// How the copies of a body start.
struct Release {
    Vector3d position = Vector3d::Zero();               ///< of the shape file's origin (m, world)
    Quaterniond orientation = Quaterniond::Identity();  ///< shape axes to world
    Vector3d velocity = Vector3d::Zero();               ///< of the centre of mass (m/s, world)
    Vector3d angular_velocity = Vector3d::Zero();       ///< rad/s, world
    double start = 0.0;                                 ///< s: held in place until then
    int count = 1;                                      ///< of copies
    Vector3d spread_position =
        Vector3d::Zero();       ///< m: copies start within +- this of `position`, each axis uniform
    double spread_angle = 0.0;  ///< rad: copies are turned by up to this about a random axis
};

}  // namespace samara
