#pragma once

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/collision/obstacle_contact.hpp"

namespace samara {

/// A body's place, and its velocity (omega, v) of the centre of mass in world axes.
struct PlacedMotion {
    BodyPlace place;
    Vector6d velocity;
};

/// Returns the place and velocity after a time (s) of a body of inertia K (body axes, about the centre of
/// mass) without any load, in a fluid at rest in the frame of the velocity: Kirchhoff's equations by the
/// midpoint rule, in one step. Energy and momentum, and without a fluid angular momentum, are conserved to
/// rounding. Where the body rotates by more than about a radian the equations may not be solved: then it
/// rotates about its axis with its velocity constant in body axes, which conserves the energy alone.
PlacedMotion free_flight(const Matrix6d& inertia, const PlacedMotion& begin, double time) noexcept;

}  // namespace samara
