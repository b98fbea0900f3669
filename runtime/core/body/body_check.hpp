#pragma once

#include <string>

#include "samara/core/body/body.hpp"

namespace samara {

/// What no real body can be, in words that begin with the place in its file, such as "/kirchhoff/added_mass
/// is not symmetric"; empty where nothing is wrong. Asked for are: a size between 1e-9 and 1e9 m; a volume
/// that the surface encloses, with its centroid in it and second moments that such a volume can have;
/// orthonormal axes and symmetries; an added mass that is symmetric, positive semidefinite, and no larger
/// than that of the sphere around the body; load tables for a body of this size, with k, epsilon and standard
/// errors that are not negative; coefficients of a body of this size.
std::string error_of(const Body& body);

}  // namespace samara
