#pragma once

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/kernel/body_state.hpp"

namespace samara {

/// (omega, v, q, x, s, m): the velocities as in BodyState, the quaternion (w, x, y, z), the position of the
/// centre of mass and the wake's share and heading; or the rates at which these change.
using MotionVector = Eigen::Matrix<double, 17, 1>;

MotionVector motion_vector(const BodyState& state) noexcept;
/// The state with these motions, its quaternion made a unit one; `seen_fluid` is passed on.
BodyState body_state(const MotionVector& motion, const SeenFluid& seen_fluid) noexcept;

/// The body's equations as ordinary differential equations, for integrators that know nothing of bodies:
/// those that implicit_step solves, with gravity and the seen fluid held (docs/theory, "The equations that
/// are solved").
///
/// R(q) is the homogeneous quadratic form of q, also where |q| is not 1 inside a step. Then u K u / 2, |p|^2,
/// l . p and |q|^2 without loads, and with gravity the total energy, are quadratic in the MotionVector and
/// kept by the equations for any q: integrators that keep quadratic invariants keep them.
class EquationsOfMotion {
  public:
    /// `body` must outlive the equations. `gravity`: m/s^2, world axes.
    EquationsOfMotion(const ImmersedBody& body, const Vector3d& gravity,
                      const SeenFluid& seen_fluid) noexcept;

    [[nodiscard]] MotionVector rate(const MotionVector& motion) const noexcept;

    /// How the acceleration changes with the velocity, du'/du (6x6): exact in the Kirchhoff terms, by
    /// differences in the loads.
    [[nodiscard]] Matrix6d acceleration_gradient(const MotionVector& motion) const noexcept;

  private:
    /// The loads, moment and force about the centroid, at a velocity (omega, v) of the centre of mass of
    /// which v is relative to the seen fluid.
    [[nodiscard]] Vector6d load(const Vector6d& velocity, const Matrix3d& to_world,
                                const WakeShares& shares) const noexcept;

    const ImmersedBody* body_;
    Matrix6d mobility_;  // the inverse of the inertia
    Vector3d gravity_;
    SeenFluid seen_fluid_;
};

}  // namespace samara
