#pragma once

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// The lever of the load at a contact point, relative to the bounding radius: it stops a ball that rolls and
/// a body that rocks or spins. Chosen, not measured: 0.1 mm for a body of 2 cm
/// (docs/explanation/integrator.md#ground).
inline constexpr double rolling_resistance = 0.005;

/// Tells what the impulses at a point do.
struct Held {
    bool touches = false;             ///< whether there are or were any
    bool slip = false, spin = false;  ///< which of them cause the target rates, within their bounds
};

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
    Matrix3d spin_by_push;                  ///< rates about the axes of unit impulses along them
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
    /// Updates the impulses while those at all other points stay. `slide` and `turn`: velocity (m/s) and
    /// angular velocity (rad/s) of the first body at the point, relative to the second or to unmoved
    /// surfaces, in the frame of the axes. `change` receives the change of the size where they touch.
    Held relax(const Vector3d& slide, const Vector3d& turn, Vector6d& change) noexcept;
    /// Returns the impulse (N s) on the first body.
    [[nodiscard]] Vector3d push() const noexcept { return axes.transpose() * size.head<3>(); }
    /// Returns the work (J) of the surface.
    [[nodiscard]] double work() const noexcept;
};

/// Returns the share of the impulses that adds no energy. Their work (J) on the velocities before, and their
/// square by the inverse inertia (J) are given. Friction that was bounded by a normal impulse which later
/// fell may add a little.
double passive_share(double gain, double square) noexcept;

/// Returns two tangents and the normal, as rows.
Matrix3d axes_about(const Vector3d& normal) noexcept;

}  // namespace samara
