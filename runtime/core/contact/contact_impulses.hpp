#pragma once

#include <utility>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// The lever of the load at a contact point, relative to the bounding radius: it stops a ball that rolls and
/// a body that rocks or spins. Chosen, not measured: 0.1 mm for a body of 2 cm
/// (docs/explanation/integrator.md#ground).
inline constexpr double rolling_resistance = 0.005;

/// The impulses at one contact point: forces along two tangents and the normal, and moments against rolling
/// and spinning about the same axes. One body receives them, and what it touches the opposite.
struct ContactImpulses {
    using Response = Eigen::Matrix<double, 6, 3>;
    /// The velocity (omega, v) that unit impulses along and about the axes give a body.
    struct Side {
        Response push, spin;
    };

    Matrix3d axes;  ///< two tangents and the normal, as rows
    Side first, second;
    Matrix3d push_mobility, spin_mobility;  ///< rates along and about the axes of unit impulses
    Eigen::Matrix2d slip_inverse;           ///< of the mobility along the tangents
    Matrix3d spin_inverse;
    Vector3d target, target_spin;  ///< target rates of the impulses
    double rising;                 ///< m/s: of the surface, along the normal
    double friction;
    double lever;   ///< m
    Vector6d size;  ///< along the axes, then about them

    /// Sets all but mobilities and responses, with impulses of zero: for a surface with a velocity (m/s) and
    /// an angular velocity (rad/s), between bodies the smaller of which is held by a sphere of a radius (m).
    void begin(const Matrix3d& along, const Vector3d& surface_velocity,
               const Vector3d& surface_angular_velocity, double friction_coefficient, double radius) noexcept;
    /// Computes the inverse mobilities. Call it once the mobilities are set.
    void invert() noexcept;
    /// Returns the impulse (N s) on the first body.
    [[nodiscard]] Vector3d push() const noexcept { return axes.transpose() * size.head<3>(); }
    /// Returns the work (J) of the surface.
    [[nodiscard]] double work() const noexcept;
};

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

/// Returns the share of the impulses that adds no energy. Their work (J) on the velocities before, and their
/// square by the inverse inertia (J) are given. Friction that was bounded by a normal impulse which later
/// fell may add a little.
double passive_share(double gain, double square) noexcept;

/// Returns two tangents and the normal, as rows.
Matrix3d axes_about(const Vector3d& normal) noexcept;

}  // namespace samara
