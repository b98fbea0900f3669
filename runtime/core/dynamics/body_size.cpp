#include "samara/core/dynamics/body_size.hpp"

namespace samara {
namespace {

/// Scales lengths by `length` and times by its square.
BodyState in_units(const BodyState& state, double length) noexcept {
    const double angular = 1.0 / (length * length);
    const double linear = length * angular;
    BodyState result = state;
    result.position *= length;
    result.velocity.head<3>() *= angular;
    result.velocity.tail<3>() *= linear;
    result.sampled_turbulence.velocity *= linear;
    result.sampled_turbulence.angular_velocity *= angular;
    result.acceleration.head<3>() *= angular * angular;
    result.acceleration.tail<3>() *= linear * angular;
    return result;
}

}  // namespace

BodyState in_own_units(const BodyState& state, double size) noexcept {
    return in_units(state, 1.0 / size);
}

BodyState in_world_units(const BodyState& state, double size) noexcept {
    return in_units(state, size);
}

Pose in_own_units(const Pose& pose, double size) noexcept {
    Pose result = pose;
    result.position /= size;
    result.velocity *= size;
    result.angular_velocity *= size * size;
    return result;
}

double own_share(const ImmersedBody& body, double size) noexcept {
    return body.keeps_thickness ? 1.0 / size : 1.0;
}

Matrix6d inertia_of_size(const ImmersedBody& body, double size) {
    return body.inertia + (own_share(body, size) - 1.0) * own_inertia(body);
}

TouchingBody touching_body(const ImmersedBody& body, double size) {
    const Matrix6d inertia = inertia_of_size(body, size);
    const double volume = size * size * size;
    TouchingBody result;
    result.contact_points = body.contact_points;
    ContactPoints& points = result.contact_points;
    for (Vector3d& corner : points.corners) corner *= size;
    for (Vector3d& point : points.round) point *= size;
    points.bounding_radius *= size;
    points.middle *= size;
    result.inertia.topLeftCorner<3, 3>() = (size * size * volume) * inertia.topLeftCorner<3, 3>();
    result.inertia.topRightCorner<3, 3>() = (size * volume) * inertia.topRightCorner<3, 3>();
    result.inertia.bottomLeftCorner<3, 3>() = (size * volume) * inertia.bottomLeftCorner<3, 3>();
    result.inertia.bottomRightCorner<3, 3>() = volume * inertia.bottomRightCorner<3, 3>();
    result.inverse_inertia = result.inertia.inverse();
    return result;
}

}  // namespace samara
