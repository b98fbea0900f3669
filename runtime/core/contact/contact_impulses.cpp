#include "samara/core/contact/contact_impulses.hpp"

#include <algorithm>
#include <utility>

#include <Eigen/LU>

namespace samara {
namespace {

/// Stops rates where impulses within `bound` can, else slows them: returns the new size, and whether the
/// rates stop. `inverse`: of the mobility, whose trace is given. Never gains energy.
template <int N>
std::pair<Eigen::Matrix<double, N, 1>, bool> held(const Eigen::Matrix<double, N, 1>& size,
                                                  const Eigen::Matrix<double, N, 1>& rates,
                                                  const Eigen::Matrix<double, N, N>& inverse, double trace,
                                                  double bound) {
    Eigen::Matrix<double, N, 1> after = size - inverse * rates;
    if (after.norm() <= bound) return {after, true};
    // A step of projected gradients, no longer than the mobility's trace allows, so that it never gains
    // energy.
    after = size - rates / trace;
    const double length = after.norm();
    if (length > bound) after *= bound / length;
    return {after, false};
}

}  // namespace

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

Held ContactImpulses::relax(const Vector3d& slide, const Vector3d& turn, Vector6d& change) noexcept {
    const double closing = axes.row(2).dot(slide) - target.z();
    const double normal = std::max(0.0, size[2] - closing / push_mobility(2, 2));
    if (normal == 0.0 && size.isZero(0.0)) return {};
    // The rates follow the point's own impulses by its mobilities: bodies' velocities need to change but
    // once.
    change[2] = normal - size[2];
    const Eigen::Vector2d slip =
        axes.topRows<2>() * slide - target.head<2>() + push_mobility.col(2).head<2>() * change[2];
    const auto [friction_impulse, slip_holds] = held<2>(
        size.head<2>(), slip, slip_inverse, push_mobility(0, 0) + push_mobility(1, 1), friction * normal);
    change.head<2>() = friction_impulse - size.head<2>();
    const Vector3d spin = axes * turn - target_spin + spin_by_push * change.head<3>();
    const auto [moment, spin_holds] =
        held<3>(size.tail<3>(), spin, spin_inverse, spin_mobility.trace(), lever * normal);
    change.tail<3>() = moment - size.tail<3>();
    size += change;
    return {true, slip_holds, spin_holds};
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
