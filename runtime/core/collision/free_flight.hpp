#pragma once

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/collision/obstacle_contact.hpp"

namespace samara {

/// A body's place, and its velocity (omega, v) of the centre of mass in world axes.
struct PlacedMotion {
    BodyPlace place;
    Vector6d velocity;
};

/// How a body of inertia K (body axes, about the centre of mass) moves in a time (s) without any load, in
/// fluid that is at rest where the velocity is: Kirchhoff's equations by the midpoint rule, in one step. Its
/// energy and momentum, and without a fluid its angular momentum, stay what they were to rounding. Where it
/// turns by more than a radian or so the equations may not be solved: then it turns about its axis with its
/// velocity held in body axes, which keeps the energy alone.
PlacedMotion free_flight(const Matrix6d& inertia, const PlacedMotion& begin, double time) noexcept;

}  // namespace samara
