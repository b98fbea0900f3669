#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "samara/core/base/numbers.hpp"
#include "samara/motion/motion.hpp"
#include "support/test_shapes.hpp"

namespace samara::test {

using samara::degree;

/// One copy of one body, an ellipsoid with semi-axes 4, 2, 1 cm along x, y, z, posed by a function of time.
inline Motion motion_of(const std::function<Pose(double)>& pose, double duration, double frame_rate = 60.0) {
    Motion motion;
    motion.frame_rate = frame_rate;
    BodyMotion body;
    body.name = "ellipsoid";
    body.body_hash = "0123456789abcdef0123456789abcdef";
    body.models = "loads none, turbulence none";
    body.surface = ellipsoid({0.04, 0.02, 0.01}, 2);
    const int frames = static_cast<int>(std::lround(duration * frame_rate)) + 1;
    for (int i = 0; i < frames; ++i) {
        motion.times.push_back(i / frame_rate);
        body.poses.push_back(pose(motion.times.back()));
    }
    motion.scene_text = "[scene]\nduration = 4.0  # s\n";
    motion.bodies.push_back(body);
    return motion;
}

/// A pendulum-like flutter about y: inclination |amplitude cos(2 pi frequency t)|, with the sideways drift of
/// a fluttering plate, descending at `speed`.
inline Pose flutter(double time, double frequency, double amplitude, double speed) {
    const double phase = 2.0 * std::numbers::pi * frequency * time;
    const double rate = 2.0 * std::numbers::pi * frequency;
    Pose pose;
    pose.orientation = Eigen::AngleAxisd(amplitude * std::cos(phase), Vector3d::UnitY());
    pose.angular_velocity = Vector3d(0.0, -amplitude * rate * std::sin(phase), 0.0);
    pose.position = Vector3d(0.05 * std::sin(phase), 0.01 * time, -speed * time);
    pose.velocity = Vector3d(0.05 * rate * std::cos(phase), 0.01, -speed);
    return pose;
}

/// Turning about y at constant angular velocity `spin` (rad/s), descending at `speed`.
inline Pose tumble(double time, double spin, double speed) {
    Pose pose;
    pose.orientation = Eigen::AngleAxisd(spin * time, Vector3d::UnitY());
    pose.angular_velocity = Vector3d(0.0, spin, 0.0);
    pose.position = Vector3d(0.1 * time, 0.0, -speed * time);
    pose.velocity = Vector3d(0.1, 0.0, -speed);
    return pose;
}

/// A motion without any plane or axis of its own: turning about z by sin, then about x by cos and a growing
/// angle, along a curve in space.
inline Pose wander(double time) {
    const double a = 1.3 * std::sin(4.0 * time);
    const double b = 0.9 * std::cos(5.0 * time) + 3.0 * time;
    const Quaterniond about_z(Eigen::AngleAxisd(a, Vector3d::UnitZ()));
    Pose pose;
    pose.orientation = about_z * Quaterniond(Eigen::AngleAxisd(b, Vector3d::UnitX()));
    pose.angular_velocity = 5.2 * std::cos(4.0 * time) * Vector3d::UnitZ() +
                            (3.0 - 4.5 * std::sin(5.0 * time)) * (about_z * Vector3d::UnitX());
    pose.position = Vector3d(0.1 * std::sin(6.0 * time), 0.2 * std::cos(3.0 * time), -0.3 * time);
    pose.velocity = Vector3d(0.6 * std::cos(6.0 * time), -0.6 * std::sin(3.0 * time), -0.3);
    return pose;
}

/// Has the body's copies wander, each a second ahead of the one before.
inline void let_wander(BodyMotion& body, int copies, const std::vector<double>& times) {
    body.copies = copies;
    body.poses.clear();
    for (const double time : times) {
        for (int copy = 0; copy < copies; ++copy) body.poses.push_back(wander(time + copy));
    }
}

}  // namespace samara::test
