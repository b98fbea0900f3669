#pragma once

#include <string>

#include "samara/core/physics/mass_specification.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// What is wrong with a mass, in words that follow "body 'seed': ", with what it must be; empty where nothing
/// is. Principal moments of inertia are positive, each at most the sum of the others.
std::string error_of(const MassSpecification& mass);

/// The same of what a body is said to weigh by itself: its centre of mass lies within the box around its
/// surface. A scene may hang a weight outside of it.
std::string error_of(const MassSpecification& mass, const Surface& surface);

}  // namespace samara
