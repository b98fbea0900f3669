#pragma once

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/kernel/body_state.hpp"

namespace samara {

/// Returns the matrices D (6x6, order omega then v) of the loads beyond the Kirchhoff terms: moment about the
/// centroid and force (N m, N) are -D u. Their symmetric part is positive semidefinite, so the loads never
/// add energy in still fluid (docs/explanation/moving-loads.md#the-terms). In a fluid that rotates with
/// `sampled_rotation` (rad/s, body axes) they are -whole u + relative (sampled_rotation, 0), where u holds
/// the body's own angular velocity and the velocity of its centroid relative to the fluid, of which
/// `wake_fluctuation` (m/s, body axes) is the part by its own wake. Never throws.
LoadMatrices load_matrices(const ImmersedBody& body, const Vector6d& velocity,
                           const Vector3d& sampled_rotation,
                           const Vector3d& wake_fluctuation = Vector3d::Zero(),
                           const WakeShares& shares = {}) noexcept;

/// Returns the share of the wake that has formed, and the length of the heading to the eighth power
/// (docs/explanation/moving-loads.md#a-wake-that-forms).
WakeShares shares_of(const Wake& wake) noexcept;

/// The rates of change of a wake at the velocity u of load_matrices(). Zero where the loads do not depend on
/// its formation: their wake is always formed.
struct WakeRates {
    double formation = 0.0;  ///< 1/s: the rate at which Wake::formed tends to one
    double settling = 0.0;   ///< 1/s: the rate at which Wake::heading tends to the velocity's direction
    Vector3d spin_about_symmetry = Vector3d::Zero();  ///< rad/s: the body's spin under its heading
};
WakeRates wake_rates(const ImmersedBody& body, const Vector6d& relative_velocity) noexcept;

/// Returns the Reynolds number U L / nu of a speed (m/s).
double reynolds_number(const ImmersedBody& body, double speed) noexcept;

/// Returns the turbulence around the body at a velocity of its centroid relative to the mean current (m/s,
/// body axes).
TurbulenceLevel turbulence_level(const ImmersedBody& body, const Vector3d& velocity) noexcept;

/// Returns the rate (1/s) at which the wake's velocity fluctuation renews itself at such a velocity; 0 where
/// there is no turbulence.
double wake_renewal_rate(const ImmersedBody& body, const Vector3d& velocity) noexcept;

}  // namespace samara
