#pragma once

#include "samara/base/linear_algebra.hpp"
#include "samara/dynamics/immersed_body.hpp"

namespace samara {

/// The matrix D (6x6, order omega then v) with which the loads beyond the Kirchhoff terms are -D u: u holds
/// the body's angular velocity and the velocity of its centroid relative to the fluid (rad/s, m/s; body
/// axes), the load moment about the centroid and force (N m, N). D depends on u; its symmetric part is
/// positive semidefinite, so the loads never make energy in still fluid. docs/theory, "Loads of a moving
/// body". Never throws.
Matrix6d load_matrix(const ImmersedBody& body, const Vector6d& relative_velocity) noexcept;

/// The same in a fluid that turns: `angular_velocity` is the body's own (rad/s, body axes), not relative to
/// the seen fluid. By it alone the flow ceases to be that of a steady tow: the tables hold what turbulence
/// turns.
Matrix6d load_matrix(const ImmersedBody& body, const Vector6d& relative_velocity,
                     const Vector3d& angular_velocity) noexcept;

/// U L / nu of a speed (m/s).
double reynolds_number(const ImmersedBody& body, double speed) noexcept;

}  // namespace samara
