#include "samara/core/contact/contact_impulses.hpp"

#include <algorithm>

#include <Eigen/LU>

namespace samara {

void ContactImpulses::begin(const Matrix3d& along, const Vector3d& surface_velocity,
                            const Vector3d& surface_angular_velocity, double friction_coefficient,
                            double radius) noexcept {
    axes = along;
    target = axes * surface_velocity;
    target_spin = axes * surface_angular_velocity;
    rising = target.z();
    friction = friction_coefficient;
    lever = rolling_resistance * radius;
    size.setZero();
}

void ContactImpulses::invert() noexcept {
    slip_inverse = push_mobility.topLeftCorner<2, 2>().inverse();
    spin_inverse = spin_mobility.inverse();
}

double ContactImpulses::work() const noexcept {
    return size.head<2>().dot(target.head<2>()) + size[2] * rising + size.tail<3>().dot(target_spin);
}

double passive_share(double gain, double square) noexcept {
    return gain + 0.5 * square <= 0.0 ? 1.0 : std::max(0.0, -gain / square);
}

Matrix3d axes_about(const Vector3d& normal) noexcept {
    Matrix3d axes;
    axes.row(0) = normal.unitOrthogonal().transpose();
    axes.row(1) = normal.cross(axes.row(0).transpose()).transpose();
    axes.row(2) = normal.transpose();
    return axes;
}

}  // namespace samara
