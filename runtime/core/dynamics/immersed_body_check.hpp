#pragma once

#include <string>

#include "samara/core/body/body.hpp"
#include "samara/core/physics/body_physics.hpp"
#include "samara/core/physics/fluid.hpp"

namespace samara {

/// Throws Error, one line that names the body and the member, where a number that make_immersed_body needs is
/// not finite or not in its range, or where tables or surface contradict themselves. What the body lacks
/// altogether (Kirchhoff tensor, tables) is no fault here.
void require_sound(const Body& body, const BodyPhysics& physics, const Fluid& fluid, const std::string& name);

}  // namespace samara
