// The reference of tests and benchmarks for steps: the same equations, solved to rounding.
#pragma once

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/dynamics/loads.hpp"
#include "samara/core/kernel/body_state.hpp"
#include "samara/core/kernel/noise.hpp"

namespace samara {

/// The matrix D (6x6, order omega then v) with which the loads beyond the Kirchhoff terms are -D u: u holds
/// the body's angular velocity and the velocity of its centroid relative to the fluid (rad/s, m/s; body
/// axes), the load moment about the centroid and force (N m, N). D depends on u; its symmetric part is
/// positive semidefinite, so the loads never add energy in still fluid. docs/explanation/moving-loads.md.
/// Never throws.
Matrix6d load_matrix(const ImmersedBody& body, const Vector6d& relative_velocity) noexcept;

/// (omega, v, q, x, s, m): the velocities as in BodyState, the quaternion (w, x, y, z), the position of the
/// centre of mass and the wake's share and heading; or the rates at which these change.
using MotionVector = Eigen::Matrix<double, 17, 1>;

MotionVector motion_vector(const BodyState& state) noexcept;
/// The state with these motions, its quaternion made a unit one; `sampled_turbulence` is passed on.
BodyState body_state(const MotionVector& motion, const SampledTurbulence& sampled_turbulence) noexcept;

/// The body's equations as ordinary differential equations, for general integrators: those that implicit_step
/// solves, with gravity and the sampled turbulence held (docs/explanation/model.md#equations-of-motion).
///
/// R(q) is the homogeneous quadratic form of q, also where |q| is not 1 inside a step. Then u K u / 2, |p|^2,
/// l . p and |q|^2 without loads, and with gravity the total energy, are quadratic in the MotionVector and
/// kept by the equations for any q: integrators that keep quadratic invariants keep them.
class EquationsOfMotion {
  public:
    /// `body` must outlive the equations. `gravity`: m/s^2, world axes.
    EquationsOfMotion(const ImmersedBody& body, const Vector3d& gravity,
                      const SampledTurbulence& sampled_turbulence) noexcept;

    [[nodiscard]] MotionVector rate(const MotionVector& motion) const noexcept;

    /// Returns du'/du (6x6), the derivative of the acceleration with respect to the velocity: exact in the
    /// Kirchhoff terms, by differences in the loads.
    [[nodiscard]] Matrix6d acceleration_gradient(const MotionVector& motion) const noexcept;

  private:
    /// The loads, moment and force about the centroid, at a velocity (omega, v) of the centre of mass of
    /// which v is relative to the sampled turbulence.
    [[nodiscard]] Vector6d load(const Vector6d& velocity, const Matrix3d& to_world,
                                const WakeShares& shares) const noexcept;

    const ImmersedBody* body_;
    Matrix6d mobility_;  // the inverse of the inertia
    Vector3d gravity_;
    SampledTurbulence sampled_turbulence_;
};

/// The result of a step of the reference integrator.
struct ReferenceResult {
    BodyState state;
    int parts = 1;          ///< number of substeps, equal or unequal, that were taken
    bool converged = true;  ///< false: somewhere even the shortest part's equations were not solved, and
                            ///< implicit_step took that part
};

/// The shortest part of a reference step is the step over 2^reference_halvings.
inline constexpr int reference_halvings = 10;

/// The yardstick for implicit_step: the same equations, loads, gravity and sampled turbulence (held), by the
/// Gauss method with two stages, of the fourth order where the loads are smooth (Hairer, Lubich, Wanner,
/// Geometric Numerical Integration, 2nd ed., sections II.1.3 and IV.2).
///
/// It keeps quadratic invariants: without loads u K u / 2, |p|^2 and l . p to rounding, and with gravity the
/// total energy. In still fluid the loads never make energy. The stages are solved to rounding by a
/// simplified Newton method; where that fails, the step is halved. Never throws or allocates.
ReferenceResult reference_step(const ImmersedBody& body, const Vector3d& gravity, double time_step,
                               const BodyState& state) noexcept;

/// Advances the sampled turbulence: both velocities follow an Ornstein-Uhlenbeck process over the time step
/// (s) by its exact update, with the rate a = 3/4 C_k epsilon/k and the variance 2 k/3 of each component of
/// the velocity, and that over L^2 of the rotation. docs/explanation/noise-and-wake.md.
SampledTurbulence advance_sampled_turbulence(const ImmersedBody& body, const TurbulenceLevel& level,
                                             const SampledTurbulence& seen, double time_step,
                                             const Noise& noise, std::uint64_t step) noexcept;

/// The paper's eq. 8: the body's own velocity (omega, v; body axes, relative to the mean current) drifts with
/// (1/2 + 3/4 C_k) epsilon/k and diffuses with C_k epsilon by the exact update; its rotation diffuses without
/// drift, over the length L that eq. 8 lacks.
Vector6d advance_body_velocity(const ImmersedBody& body, const TurbulenceLevel& level,
                               const Vector6d& velocity, double time_step, const Noise& noise,
                               std::uint64_t step) noexcept;

/// Returns u K u / 2 (J): the kinetic energy of body and fluid.
double kinetic_energy(const ImmersedBody& body, const BodyState& state) noexcept;

}  // namespace samara
