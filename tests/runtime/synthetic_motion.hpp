#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "internal/base/angles.hpp"
#include "samara/motion/motion.hpp"

namespace samara::test {

using samara::degree;

/// A sphere of 20 * 4^levels triangles from an icosahedron, stretched to the semi-axes (m).
inline Surface ellipsoid_surface(const Vector3d& semi_axes, int levels) {
    const double g = std::numbers::phi;
    Surface s;
    s.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                  {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    s.corners = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
        const auto middle = [&](std::int32_t a, std::int32_t b) {
            const auto [place, is_new] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(s.vertices.size()));
            if (is_new) {
                s.vertices.push_back(0.5 * (s.vertices[static_cast<std::size_t>(a)] +
                                            s.vertices[static_cast<std::size_t>(b)]));
            }
            return place->second;
        };
        Surface finer;
        for (const auto& [a, b, c] : s.corners) {
            const auto ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.corners.insert(finer.corners.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        s.corners = finer.corners;
        for (Vector3d& vertex : s.vertices) vertex.normalize();
    }
    for (Vector3d& vertex : s.vertices) vertex = vertex.normalized().cwiseProduct(semi_axes);
    return s;
}

/// A cube with edges of 2 m about the origin, two triangles to a side.
inline Surface cube_surface() {
    Surface s;
    for (int i = 0; i < 8; ++i) s.vertices.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    s.corners = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return s;
}

/// One copy of one body, an ellipsoid with semi-axes 4, 2, 1 cm along x, y, z, posed by a function of time.
inline Motion motion_of(const std::function<Pose(double)>& pose, double duration, double frame_rate = 60.0) {
    Motion motion;
    motion.frame_rate = frame_rate;
    BodyMotion body;
    body.name = "ellipsoid";
    body.body_hash = "0123456789abcdef0123456789abcdef";
    body.models = "loads none, turbulence none";
    body.surface = ellipsoid_surface({0.04, 0.02, 0.01}, 2);
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

}  // namespace samara::test
