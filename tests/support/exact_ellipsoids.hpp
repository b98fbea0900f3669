#pragma once

#include <string>
#include <vector>

#include "samara/body/body.hpp"

namespace samara::test {

/// An ellipsoid about the origin and its exact Kirchhoff tensor for a fluid of density 1.
struct ExactEllipsoid {
    std::string name;
    Vector3d semi_axes;
    Vector3d inertia;  ///< added moments of inertia about x, y, z
    Vector3d mass;     ///< added masses along x, y, z
};

/// Lamb, Hydrodynamics, 6th ed., art. 114 and 115, with the integrals in Carlson's form to 30 digits.
const std::vector<ExactEllipsoid>& exact_ellipsoids();

/// That of any semi-axes, at least two of them different, by the same formulas with the integrals done
/// numerically, to about 1e-10.
ExactEllipsoid exact_ellipsoid(const Vector3d& semi_axes);

/// The one with the name. The name must be known.
const ExactEllipsoid& exact_ellipsoid(const std::string& name);

Matrix6d exact_tensor(const ExactEllipsoid& body);

/// Volume, centroid and second moments are exact; the surface area is that of a fine mesh.
VolumeMoments exact_moments(const ExactEllipsoid& body);

}  // namespace samara::test
