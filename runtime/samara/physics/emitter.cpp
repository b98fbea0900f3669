#include "samara/physics/emitter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "samara/base/error.hpp"

namespace samara {
namespace {

struct RigidMotion {
    Vector3d velocity = Vector3d::Zero();  // of the shape's origin
    Vector3d angular_velocity = Vector3d::Zero();
};

RigidMotion motion_between(const ObstacleKey& before, const ObstacleKey& after) {
    const double duration = after.time - before.time;
    Quaterniond turn = after.orientation * before.orientation.conjugate();
    if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
    const Eigen::AngleAxisd about(turn);
    return {(after.position - before.position) / duration, (about.angle() / duration) * about.axis()};
}

RigidMotion motion_at(const std::vector<ObstacleKey>& keys, double time) {
    const auto after = std::upper_bound(keys.begin(), keys.end(), time,
                                        [](double at, const ObstacleKey& key) { return at < key.time; });
    if (after == keys.begin() || after == keys.end()) return {};
    return motion_between(*std::prev(after), *after);
}

}  // namespace

Emitter make_emitter(Obstacle mesh, double offset, double speed) {
    Emitter emitter{std::move(mesh), offset, speed, {}};
    const Surface& surface = emitter.mesh.surface;
    double area = 0.0;
    for (std::size_t i = 0; i < surface.triangle_count(); ++i) {
        area += area_vector(surface, i).norm();
        emitter.areas.push_back(area);
    }
    double reach = 0.0;
    for (const Vector3d& vertex : surface.vertices) reach = std::max(reach, vertex.norm());
    const std::vector<ObstacleKey>& keys = emitter.mesh.keys;
    for (std::size_t i = 1; i < keys.size(); ++i) {
        const RigidMotion motion = motion_between(keys[i - 1], keys[i]);
        const double fastest = motion.velocity.norm() + reach * motion.angular_velocity.norm();
        if (fastest <= most_emitter_speed) continue;
        throw Error(
            fmt::format("jumps: from {:g} s to {:g} s it moves at {:.3g} m/s, and {:g} is the most; put its "
                        "keys farther apart in time",
                        keys[i - 1].time, keys[i].time, fastest, most_emitter_speed));
    }
    return emitter;
}

Emission emission(const Emitter& emitter, double time, const std::array<double, 3>& numbers) {
    const auto found = std::upper_bound(emitter.areas.begin(), std::prev(emitter.areas.end()),
                                        numbers[0] * emitter.areas.back());
    const auto triangle = static_cast<std::size_t>(found - emitter.areas.begin());
    const Surface& surface = emitter.mesh.surface;
    const auto corner = [&](std::size_t i) {
        return surface.vertices[static_cast<std::size_t>(surface.corners[triangle][i])];
    };
    // A uniform point of a triangle: Osada et al., Shape distributions, ACM TOG 21 (2002), eq. 1.
    const double root = std::sqrt(numbers[1]);
    const Vector3d normal = area_vector(surface, triangle).normalized();
    const Vector3d point = (1.0 - root) * corner(0) + root * (1.0 - numbers[2]) * corner(1) +
                           root * numbers[2] * corner(2) + emitter.offset * normal;
    const ObstaclePlace place = place_of(emitter.mesh, time);
    const RigidMotion motion = motion_at(emitter.mesh.keys, time);
    const Vector3d arm = place.orientation * point;
    return {
        {place(point), place.orientation},
        motion.velocity + motion.angular_velocity.cross(arm) + place.orientation * (emitter.speed * normal),
        motion.angular_velocity};
}

}  // namespace samara
