#pragma once

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// The place and motion of one copy of a body at one time.
struct Pose {
    Vector3d position = Vector3d::Zero();               ///< of the centre of mass (m, world)
    Quaterniond orientation = Quaterniond::Identity();  ///< body to world
    Vector3d velocity = Vector3d::Zero();               ///< of the centre of mass (m/s, world)
    Vector3d angular_velocity = Vector3d::Zero();       ///< rad/s, world axes
};

/// Returns the place of the shape file's origin (m, world) at a pose of the centre of mass (m, shape axes).
inline Vector3d shape_origin(const Pose& pose, const Vector3d& center_of_mass) {
    return pose.position - pose.orientation * center_of_mass;
}

/// Returns a pose between two that lie `duration` (s) apart, at `fraction` (0 to 1) of it: cubic in the
/// position, so that it agrees with the velocities at both ends, linear in these, and by the shortest
/// rotation in the orientation.
Pose interpolated(const Pose& before, const Pose& after, double fraction, double duration);

/// Returns a smooth pose between two that lie `duration` (s) apart, at `fraction` (0 to 1) of it, for frames
/// that are far apart: both position and orientation agree with the velocities at both ends, and the
/// velocities are their derivatives. The position is cubic. The orientation is q exp(s t) exp(c(s)) with the
/// rotation t from one pose to the other and a cubic c that is zero at both ends. Of the rotations that lead
/// there, which differ by whole revolutions, t is the nearest to the mean of the angular velocities times the
/// duration. The error is of the fourth order in the duration for smooth motion.
Pose smoothly_interpolated(const Pose& before, const Pose& after, double fraction, double duration);

/// Gives the orientation the sign (q and -q are the same rotation) that is nearer to the one before.
void keep_sign_continuous(Quaterniond& orientation, const Quaterniond& before);

}  // namespace samara
