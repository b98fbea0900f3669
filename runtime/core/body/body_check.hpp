#pragma once

#include <string>

#include "samara/core/body/body.hpp"
#include "samara/core/physics/mass_specification.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// Returns what makes a body impossible, in words that begin with the place in its file, such as
/// "/kirchhoff/added_mass is not symmetric"; empty where nothing does. It asks for: a size between 1e-9 and
/// 1e9 m; a volume that the surface encloses, with its centroid in it and second moments that such a volume
/// can have; orthonormal axes and symmetries; an added mass that is symmetric, positive semidefinite, and no
/// larger than that of the sphere around the body; load tables for a body of this size, with k, epsilon and
/// standard errors that are not negative; coefficients of a body of this size.
std::string error_of(const Body& body);

/// Returns what is wrong with a mass and what it must be, in words that follow "body 'seed': "; empty where
/// nothing is. Principal moments of inertia must be positive, each at most the sum of the others.
std::string error_of(const MassSpecification& mass);

/// Returns what is wrong with the mass that a body's own file gives: error_of(mass), and that the centre of
/// mass must lie within the bounding box of its surface. A scene may hang a weight outside of it.
std::string error_of(const MassSpecification& mass, const Surface& surface);

}  // namespace samara
