#pragma once

#include <string>

#include "samara/core/body/body.hpp"
#include "samara/core/physics/mass_specification.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// What no real body can be, in words that begin with the place in its file, such as "/kirchhoff/added_mass
/// is not symmetric"; empty where nothing is wrong. Asked for are: a size between 1e-9 and 1e9 m; a volume
/// that the surface encloses, with its centroid in it and second moments that such a volume can have;
/// orthonormal axes and symmetries; an added mass that is symmetric, positive semidefinite, and no larger
/// than that of the sphere around the body; load tables for a body of this size, with k, epsilon and standard
/// errors that are not negative; coefficients of a body of this size.
std::string error_of(const Body& body);

/// What is wrong with a mass, in words that follow "body 'seed': ", with what it must be; empty where nothing
/// is. Principal moments of inertia are positive, each at most the sum of the others.
std::string error_of(const MassSpecification& mass);

/// The same of what a body is said to weigh by itself: its centre of mass lies within the box around its
/// surface. A scene may hang a weight outside of it.
std::string error_of(const MassSpecification& mass, const Surface& surface);

}  // namespace samara
