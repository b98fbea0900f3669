#pragma once

#include <string>

#include "samara/base/linear_algebra.hpp"

namespace samara {

/// What a body in rotation feels beyond the loads of a steady tow, body axes about the centroid of the volume
/// (docs/theory, "Loads of a moving body"). M is the added mass, Q = c |omega| the tip speed, H = sqrt(|v|^2
/// + Q^2).
struct DynamicCoefficients {
    /// k_c: separated flow adds the force k_c omega x (M v) to the potential flow's.
    double force_transport = 0.0;
    /// k_m: and the moment k_m v x (M v). Their mean does no work; half their difference does, as far as the
    /// drag and the rotational drag below can pay for it.
    double moment_transport = 0.0;
    /// C_m A (m^2), symmetric and positive semidefinite: drag in motion, F = -rho/2 (Q^2/H) C_m A v.
    Matrix3d drag_in_motion = Matrix3d::Zero();
    /// C_w D (m^4), symmetric and positive semidefinite: turning, M = -rho/2 H C_w D omega.
    Matrix3d rotational_drag = Matrix3d::Zero();
    /// c (m): the body's half-length.
    double half_length = 0.0;
    std::string origin;  ///< where they come from, in words, for reports
};

/// Coefficients with the standard error of each.
struct IdentifiedCoefficients {
    DynamicCoefficients values;
    DynamicCoefficients standard_errors;  ///< without half-length and origin
};

/// What is wrong with the coefficients, such as "drag_in_motion is not symmetric": a number that is not
/// finite, a tensor that is not symmetric and positive semidefinite, a half-length that is not positive.
/// Empty where nothing is.
std::string fault_of(const DynamicCoefficients& coefficients);

}  // namespace samara
