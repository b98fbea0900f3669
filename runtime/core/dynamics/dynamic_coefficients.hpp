#pragma once

#include "samara/core/body/body.hpp"

namespace samara {

/// The coefficients that bodies have in common, by their free falls in full CFD (docs/studies/falls): T
/// relative to the added mass, t, C_m, C_s, C_w and C_r.
inline constexpr double usual_transport = 1.0;
inline constexpr double usual_rotational_transport = 1.0;
inline constexpr double usual_drag_in_motion = 0.5;
inline constexpr double usual_drag_in_spin = 0.3;
inline constexpr double usual_rotational_drag = 0.7;
inline constexpr double usual_rotational_drag_in_spin = 0.7;

/// The coefficients that all bodies share beside loads of the surface; chosen on measured falls and the
/// reference falls (docs/explanation/loads-without-a-bake.md).
struct SurfaceMotion {
    double transport = 0.76;  ///< T relative to the added mass
    double spin_lift = 1.3;   ///< added to T, equal in all axes, relative to a third of the added mass' trace
    double drag_in_motion = 1.7;           ///< C_m
    double drag_in_spin = 0.6;             ///< C_s
    double rotational_drag = 0.15;         ///< C_w
    double rotational_drag_in_spin = 0.8;  ///< C_r
    /// relative to C_w: what a laminar boundary layer adds at H L / nu = 1000; elsewhere by the root of its
    /// inverse
    double laminar_rotational_drag = 1.0;
    /// The value of (|v|/Q)^2 at which half of the spin lift is left, which a wing does not have that stalls
    /// by its rotation.
    double spin_lift_onset = 1.4;
};

/// Returns the defaults for a body whose file holds none, guided by free falls of spheroids and a 1:2:4
/// ellipsoid in OpenFOAM (docs/explanation/moving-loads.md gives their errors), scaled by the body's own
/// projected areas and its rotational drag tensor.
DynamicCoefficients default_dynamic_coefficients(const Body& body);

/// Returns the coefficients that all bodies share beside loads of the surface, scaled by the body's own added
/// mass, projected areas and rotational drag tensor. Without a Kirchhoff tensor the transport is zero.
DynamicCoefficients surface_dynamic_coefficients(const Body& body, const SurfaceMotion& motion = {});

/// Returns rotational drag alone, for loads by drag and lift coefficients: C_w D, and no other term.
DynamicCoefficients rotational_drag_alone(const Body& body);

/// Returns no coefficients: the flow of the body is that of a steady translation at every instant, but for
/// the moment of creeping rotation.
DynamicCoefficients no_dynamic_coefficients(const Body& body);

/// Returns A, the areas projected along the body's principal axes (m^2), as a tensor in body axes.
Matrix3d projected_area_tensor(const Body& body);

/// Returns D, 1/2 the integral over the surface of (r x n)(r x n)^T dA (m^4), r from the centroid: symmetric,
/// positive semidefinite, zero for a sphere.
Matrix3d rotational_drag_tensor(const Surface& surface, const Vector3d& centroid);

}  // namespace samara
