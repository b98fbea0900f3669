#pragma once

#include "samara/base/linear_algebra.hpp"

namespace samara {

/// The place and motion of one copy of a body at one time.
struct Pose {
    Vector3d position = Vector3d::Zero();               ///< of the centre of mass (m, world)
    Quaterniond orientation = Quaterniond::Identity();  ///< body to world
    Vector3d velocity = Vector3d::Zero();               ///< of the centre of mass (m/s, world)
    Vector3d angular_velocity = Vector3d::Zero();       ///< rad/s, world axes
};

/// The place of the shape file's origin (m, world) at a pose of the centre of mass.
inline Vector3d shape_origin(const Pose& pose, const Vector3d& center_of_mass) {
    return pose.position - pose.orientation * center_of_mass;
}

/// A pose between two that lie `duration` (s) apart, at `fraction` (0 to 1) of it: cubic in the position, so
/// that it agrees with the velocities at both ends, linear in these, and the shortest turn in the
/// orientation.
Pose interpolated(const Pose& before, const Pose& after, double fraction, double duration);

/// Gives the orientation the sign (q and -q are the same turn) that is nearer to the one before.
void keep_sign_continuous(Quaterniond& orientation, const Quaterniond& before);

}  // namespace samara
