#pragma once

#include "samara/body/body.hpp"

namespace samara {

/// The defaults for a body whose file holds none: guided by free falls of spheroids and a 1:2:4 ellipsoid in
/// OpenFOAM (docs/theory gives the figures and what they miss). Scaled by the body's own projected areas and
/// its rotational drag tensor.
DynamicCoefficients default_dynamic_coefficients(const Body& body);

/// Rotational drag alone, for loads by drag and lift coefficients: the same C_w D, and no other term.
DynamicCoefficients rotational_drag_alone(const Body& body);

/// D = 1/2 the integral over the surface of (r x n)(r x n)^T dA (m^4), r from the centroid: symmetric,
/// positive semidefinite, zero for a sphere.
Matrix3d rotational_drag_tensor(const Surface& surface, const Vector3d& centroid);

}  // namespace samara
