#include "samara/core/physics/emitter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "samara/core/base/error.hpp"
#include "samara/core/physics/broken_rule.hpp"
#include "samara/core/physics/obstacle_motion.hpp"

namespace samara {

Emitter make_emitter(Obstacle mesh, double offset, double speed) {
    Emitter emitter{std::move(mesh), offset, speed, {}};
    const Surface& surface = emitter.mesh.surface;
    double area = 0.0;
    for (std::size_t i = 0; i < surface.triangle_count(); ++i) {
        area += area_vector(surface, i).norm();
        emitter.areas.push_back(area);
    }
    if (const auto broken = broken_rule(emitter.mesh)) throw Error(broken->member + " " + broken->what);
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
    // Chooses a uniform point of the triangle: Osada et al., Shape distributions, ACM TOG 21 (2002), eq. 1.
    const double root = std::sqrt(numbers[1]);
    const Vector3d normal = area_vector(surface, triangle).normalized();
    const Vector3d point = (1.0 - root) * corner(0) + root * (1.0 - numbers[2]) * corner(1) +
                           root * numbers[2] * corner(2) + emitter.offset * normal;
    const ObstaclePlace place = place_of(emitter.mesh, time);
    const ObstacleMotion motion = motion_of(emitter.mesh, time);
    const Vector3d arm = place.orientation * point;
    return {
        {place(point), place.orientation},
        motion.velocity + motion.angular_velocity.cross(arm) + place.orientation * (emitter.speed * normal),
        motion.angular_velocity};
}

}  // namespace samara
