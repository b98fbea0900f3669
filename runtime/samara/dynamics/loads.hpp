#pragma once

#include "samara/base/linear_algebra.hpp"
#include "samara/dynamics/immersed_body.hpp"

namespace samara {

/// The fluid's load on a body in a steady tow along a unit direction, over the square of its speed: force (N
/// s^2/m^2) and moment about the centroid of the volume (N s^2/m). Body axes. The moment of a table is the
/// whole moment that CFD gave, the Kirchhoff moment (M v) x v in it; that of coefficients is the moment of
/// their force alone.
struct TowLoad {
    Vector3d force = Vector3d::Zero();
    Vector3d moment = Vector3d::Zero();
};

/// The load of a steady tow at the given speed (m/s): of the table (held at its Reynolds numbers' ends) or of
/// the paper's eq. 5 in a form without singularity (docs/theory). Zero where the body has no loads.
TowLoad tow_load(const ImmersedBody& body, const Vector3d& direction, double speed) noexcept;

/// The matrix D (6x6, order omega then v) with which the loads beyond the Kirchhoff terms are -D u: u holds
/// the body's angular velocity and the velocity of its centroid relative to the fluid (rad/s, m/s; body
/// axes), the load moment about the centroid and force (N m, N). D depends on u; its symmetric part is
/// positive semidefinite, so the loads never make energy in still fluid. docs/theory, "Loads of a moving
/// body". Never throws.
Matrix6d load_matrix(const ImmersedBody& body, const Vector6d& relative_velocity) noexcept;

/// U L / nu of a speed (m/s).
double reynolds_number(const ImmersedBody& body, double speed) noexcept;

}  // namespace samara
