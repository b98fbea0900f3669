#pragma once

#include <string>
#include <vector>

#include "samara/core/body/body.hpp"

namespace samara::test {

/// An ellipsoid about the origin and its exact Kirchhoff tensor for a fluid of density 1.
struct ExactEllipsoid {
    std::string name;
    Vector3d semi_axes;
    Vector3d inertia;  ///< added moments of inertia about x, y, z
    Vector3d mass;     ///< added masses along x, y, z
};

/// Returns the ellipsoids with known tensors: Lamb, Hydrodynamics, 6th ed., art. 114 and 115, with the
/// integrals in Carlson's form to 30 digits.
const std::vector<ExactEllipsoid>& exact_ellipsoids();

/// Returns the ellipsoid of any semi-axes, at least two of them different, by the same formulas with the
/// integrals computed numerically, to about 1e-10.
ExactEllipsoid exact_ellipsoid(const Vector3d& semi_axes);

/// Returns the ellipsoid with the name, which must be known.
const ExactEllipsoid& exact_ellipsoid(const std::string& name);

Matrix6d exact_tensor(const ExactEllipsoid& body);

/// Returns the moments of an ellipsoid: volume, centroid and second moments are exact; the surface area is
/// that of a fine mesh.
VolumeMoments exact_moments(const ExactEllipsoid& body);

/// The Kirchhoff tensor of the cube with edges of length 1, extrapolated from the hypersingular method on
/// 3,072, 12,288 and 49,152 graded triangles, which converge from below with the order 2.3: 0.63745, 0.63823,
/// 0.63838 (translation) and 0.038956, 0.039198, 0.039248 (rotation).
Matrix6d unit_cube_tensor();

/// The added mass broadside of the square plate without thickness, edges of length 1. Lattice extrapolation,
/// within 0.15 % of DNV-RP-C205, table A-2 (coefficient 0.5790 over pi/4 a^3).
double unit_plate_added_mass();

}  // namespace samara::test
