#pragma once

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/kernel/body_state.hpp"
#include "samara/core/kernel/noise.hpp"

namespace samara {

/// The turbulence that the body meets at a velocity of its centroid relative to the mean current (m/s, body
/// axes).
TurbulenceLevel turbulence_level(const ImmersedBody& body, const Vector3d& velocity) noexcept;

/// The seen-fluid form: both velocities follow an Ornstein-Uhlenbeck process over the time step (s) by its
/// exact update, with the rate a = 3/4 C_k epsilon/k and the variance 2 k/3 of each component of the
/// velocity, and that over L^2 of the rotation. docs/theory, "Langevin".
SeenFluid advance_seen_fluid(const ImmersedBody& body, const TurbulenceLevel& level, const SeenFluid& seen,
                             double time_step, const Noise& noise, std::uint64_t step) noexcept;

/// The paper's eq. 8: the body's own velocity (omega, v; body axes, relative to the mean current) drifts with
/// (1/2 + 3/4 C_k) epsilon/k and diffuses with C_k epsilon by the exact update; its rotation diffuses without
/// drift, over the length L that eq. 8 lacks.
Vector6d advance_body_velocity(const ImmersedBody& body, const TurbulenceLevel& level,
                               const Vector6d& velocity, double time_step, const Noise& noise,
                               std::uint64_t step) noexcept;

}  // namespace samara
