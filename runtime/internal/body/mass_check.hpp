#pragma once

#include <string>

#include "samara/body/body.hpp"

namespace samara {

/// What is wrong with a mass that is given to a body, in words that follow "body 'seed': ", with what it must
/// be; empty where nothing is. A centre of mass lies within the box around the surface; principal moments of
/// inertia are positive, each at most the sum of the others.
std::string fault_of(const MassSpecification& mass, const Surface& surface);

}  // namespace samara
