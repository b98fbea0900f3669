#pragma once

#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/integrator/step.hpp"

namespace samara::test {

/// Returns a uniform body of the surface with its Kirchhoff tensor; the drag coefficient of loads by
/// coefficients is 1.2.
ImmersedBody uniform_body(const Surface& surface, double density, const Fluid& fluid,
                          Loads loads = Loads::coefficients);

/// Returns a disc about the origin, its axis along z, its rim a polygon of 96 sides.
Surface disc(double radius, double thickness, int sides = 96);

/// Returns a start above the ground: at rest, its lowest point `drop` (m) above the height 0.
BodyState above_ground(const ImmersedBody& body, const Quaterniond& orientation, double drop);

/// Returns the height (m) of the body's lowest contact point.
double lowest_point(const ImmersedBody& body, const BodyState& state);

/// Returns the state after `duration` (s) of steps without noise.
BodyState flown(const ImmersedBody& body, const Surroundings& surroundings, BodyState state, double duration,
                double time_step);

}  // namespace samara::test
