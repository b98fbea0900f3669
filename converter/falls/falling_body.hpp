#pragma once

#include <vector>

#include "converter/falls/fall_record.hpp"
#include "samara/core/body/body.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/integrator/step.hpp"
#include "samara/motion/motion.hpp"

namespace samara {

/// The body of a solved fall as the runtime flies it: loads by its tables and the dynamic coefficients it
/// has, or the default ones. Throws Error where the fall is of a body of another size.
ImmersedBody falling_body(const Body& body, const FreeFall& fall);

/// The fall's states, the first at its start with the velocities of fall.json, in SI units; the world's axes
/// are the body's (shape) axes at the start, and its origin the centre of mass there.
std::vector<BodyState> states_of(const FallRecord& record);

/// The fall's gravity (m/s^2) in the same axes.
Vector3d gravity_of(const FreeFall& fall);

/// States at even times as a motion of the body, for measures.
Motion motion_of(const Body& body, const Vector3d& gravity, double interval,
                 const std::vector<BodyState>& states);

}  // namespace samara
