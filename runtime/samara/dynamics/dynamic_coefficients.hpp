#pragma once

#include <string>

#include "samara/base/linear_algebra.hpp"
#include "samara/body/body.hpp"

namespace samara {

/// What a body in rotation feels beyond the loads of a steady tow, body axes about the centroid of the volume
/// (docs/theory, "Loads of a moving body").
struct DynamicCoefficients {
    /// kappa: the part of the Kirchhoff transport terms omega x (M v) and v x (M v) that separated flow
    /// cancels.
    double transport = 0.0;
    /// C_m A (m^2), symmetric and positive semidefinite: drag in motion, F = -rho/2 (Q^2/H) C_m A v.
    Matrix3d drag_in_motion = Matrix3d::Zero();
    /// C_w D (m^4), symmetric and positive semidefinite: turning, M = -rho/2 H C_w D omega.
    Matrix3d rotational_drag = Matrix3d::Zero();
    /// c (m): the body's half-length. Q = c |omega| is its tip speed, H = sqrt(|v|^2 + Q^2).
    double half_length = 0.0;
    std::string origin;  ///< in words, for reports
};

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
