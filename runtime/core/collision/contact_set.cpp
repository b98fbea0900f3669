#include "samara/core/collision/contact_set.hpp"

#include <algorithm>

namespace samara {

void ContactSet::add_ground(const ContactPoints& points, double height, double margin) noexcept {
    const Vector3d up = to_world_.row(2);
    const auto look_at = [&](const Vector3d& point) {
        const double gap = height + up.dot(point);
        if (gap > margin) return;
        add({.point = point,
             .normal = up,
             .gap = gap,
             .friction = ground_friction,
             .obstacle = -1,
             .surface_velocity = Vector3d::Zero(),
             .surface_angular_velocity = Vector3d::Zero()});
    };
    for (const Vector3d& corner : points.corners) look_at(corner);
    if (!points.round.empty()) look_at(lowest_round_point(points, -up));
}

void ContactSet::add(const NearPoint& near) noexcept {
    if (count_ < points_.size()) {
        points_[count_++] = near;
        return;
    }
    const auto farthest = std::max_element(
        points_.begin(), points_.end(), [](const NearPoint& a, const NearPoint& b) { return a.gap < b.gap; });
    if (near.gap < farthest->gap) *farthest = near;
}

}  // namespace samara
