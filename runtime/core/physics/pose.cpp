#include "samara/core/physics/pose.hpp"

#include <cmath>
#include <numbers>

namespace samara {
namespace {

/// Returns the rotation about a vector by its length (rad).
Quaterniond rotation_by(const Vector3d& vector) {
    const double angle = vector.norm();
    // sin(x/2)/x near zero
    const double scale = angle > 1e-6 ? std::sin(0.5 * angle) / angle : 0.5 - angle * angle / 48.0;
    Quaterniond rotation;
    rotation.w() = std::cos(0.5 * angle);
    rotation.vec() = scale * vector;
    return rotation;
}

/// Returns the rotation vector of `rotation` that is nearest to `guess` among those that differ by whole
/// revolutions.
Vector3d nearest_rotation_vector(const Quaterniond& rotation, const Vector3d& guess) {
    constexpr double whole = 2.0 * std::numbers::pi;
    const double sine = rotation.vec().norm();
    const double angle = 2.0 * std::atan2(sine, rotation.w());
    if (sine < 1e-12) {  // whole revolutions, whose axis only the guess knows
        const double revolutions = std::round(guess.norm() / whole);
        return revolutions > 0.0 ? Vector3d(revolutions * whole * guess.normalized())
                                 : Vector3d(2.0 * rotation.vec());
    }
    const Vector3d axis = rotation.vec() / sine;
    return (angle + whole * std::round((guess.dot(axis) - angle) / whole)) * axis;
}

/// Returns the angular velocity, in the axes at the end, of exp(c) while c changes at `rate`.
Vector3d angular_velocity_of(const Vector3d& c, const Vector3d& rate) {
    const double square = c.squaredNorm();
    const double angle = std::sqrt(square);
    const bool small = angle < 1e-3;
    const double first = small ? 0.5 - square / 24.0 : (1.0 - std::cos(angle)) / square;
    const double second = small ? 1.0 / 6.0 - square / 120.0 : (angle - std::sin(angle)) / (square * angle);
    return rate - first * c.cross(rate) + second * c.cross(c.cross(rate));
}

}  // namespace

Pose interpolated(const Pose& before, const Pose& after, double fraction, double duration) {
    const double s = fraction;
    const double r = 1.0 - s;
    // From the nearer end, so that what lies still keeps its place to the last bit and the ends are exact.
    const Vector3d displacement = after.position - before.position;
    const Vector3d place = s < 0.5 ? Vector3d(before.position + s * s * (3.0 - 2.0 * s) * displacement)
                                   : Vector3d(after.position - r * r * (3.0 - 2.0 * r) * displacement);
    return {
        .position = place + s * r * r * duration * before.velocity - s * s * r * duration * after.velocity,
        .orientation = before.orientation.slerp(s, after.orientation),
        .velocity = r * before.velocity + s * after.velocity,
        .angular_velocity = r * before.angular_velocity + s * after.angular_velocity};
}

Pose smoothly_interpolated(const Pose& before, const Pose& after, double fraction, double duration) {
    const double s = fraction;
    const double r = 1.0 - s;
    Pose pose = interpolated(before, after, fraction, duration);
    pose.velocity = 6.0 * s * r / duration * (after.position - before.position) +
                    r * (1.0 - 3.0 * s) * before.velocity + s * (3.0 * s - 2.0) * after.velocity;
    // In body axes, times the duration.
    const Vector3d first = duration * (before.orientation.conjugate() * before.angular_velocity);
    const Vector3d last = duration * (after.orientation.conjugate() * after.angular_velocity);
    const Vector3d rotation =
        nearest_rotation_vector(before.orientation.conjugate() * after.orientation, 0.5 * (first + last));
    const Vector3d c = s * r * (r * (first - rotation) - s * (last - rotation));
    const Vector3d rate = r * (1.0 - 3.0 * s) * (first - rotation) + s * (3.0 * s - 2.0) * (last - rotation);
    const Quaterniond correction = rotation_by(c);
    pose.orientation = (before.orientation * rotation_by(s * rotation) * correction).normalized();
    pose.angular_velocity =
        pose.orientation * (correction.conjugate() * rotation + angular_velocity_of(c, rate)) / duration;
    return pose;
}

void keep_sign_continuous(Quaterniond& orientation, const Quaterniond& before) {
    if (orientation.dot(before) < 0.0) orientation.coeffs() = -orientation.coeffs();
}

}  // namespace samara
