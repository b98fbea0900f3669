#pragma once

#include <string>

#include "samara/base/linear_algebra.hpp"

namespace samara {

/// How slowly a body may turn beside its speed, as (Q/|v|)^2, for its flow still to be that of a steady tow: the falls
/// in docs/falls give 0.003 to 0.1.
inline constexpr double motion_onset = 0.03;

/// What a body in rotation feels beyond the loads of a steady tow, body axes about the centroid of the volume
/// (docs/theory, "Loads of a moving body"): all vanish without rotation. Q = c |omega| is the tip speed, H =
/// sqrt(|v|^2 + Q^2).
struct DynamicCoefficients {
    /// T (m^3), symmetric: separated flow adds the force rho omega x (T v) and the moment rho v x (T v) to the
    /// potential flow's, which do no work together. T = M, the added mass, cancels the potential flow's own.
    Matrix3d transport = Matrix3d::Zero();
    /// t: the same for the fluid's angular momentum l and the part of the linear one that turning makes: the moment t
    /// omega x l and so on. 1 cancels the potential flow's.
    double rotational_transport = 0.0;
    /// C_m A (m^2), symmetric and positive semidefinite: drag in motion, F = -rho/2 H s C_m A v, with s =
    /// Q^2/(motion_onset |v|^2 + Q^2).
    Matrix3d drag_in_motion = Matrix3d::Zero();
    /// C_s A (m^2), likewise, of a body that turns fast: F = -rho/2 (Q^2/H) C_s A v.
    Matrix3d drag_in_spin = Matrix3d::Zero();
    /// C_w D (m^4), symmetric and positive semidefinite: turning, M = -rho/2 H C_w D omega.
    Matrix3d rotational_drag = Matrix3d::Zero();
    /// C_r D (m^4), likewise, of a body that turns fast: M = -rho/2 (Q^2/H) C_r D omega.
    Matrix3d rotational_drag_in_spin = Matrix3d::Zero();
    /// N_v and N_w (m^4), symmetric: the wake's angular momentum, which turns with the body and so does no work: M =
    /// rho omega x (v x (N_v v) + c^2 omega x (N_w omega))/H.
    Matrix3d wake_by_velocity = Matrix3d::Zero();
    Matrix3d wake_by_turning = Matrix3d::Zero();
    /// c (m): the body's half-length.
    double half_length = 0.0;
    /// f: of the steady tow's moment less the transport's the share |v|^2/(|v|^2 + f Q^2) stays.
    double tow_fading = motion_onset;
    std::string origin;  ///< where they come from, in words, for reports
};

/// A tensor among the coefficients, for what treats them all alike.
struct TensorOfMotion {
    Matrix3d DynamicCoefficients::*member;
    const char* name;
    const char* title;    ///< in words, for reports
    const char* unit;
    const char* meaning;  ///< the formula's symbol
    bool is_drag;         ///< positive semidefinite
};
inline constexpr TensorOfMotion tensors_of_motion[] = {
    {&DynamicCoefficients::transport, "transport", "transport", "m^3", "T, body axes", false},
    {&DynamicCoefficients::drag_in_motion, "drag_in_motion", "drag in motion", "m^2", "C_m A, body axes", true},
    {&DynamicCoefficients::drag_in_spin, "drag_in_spin", "drag in spin", "m^2", "C_s A, body axes", true},
    {&DynamicCoefficients::rotational_drag, "rotational_drag", "rotational drag", "m^4",
     "C_w D about the centroid, body axes", true},
    {&DynamicCoefficients::rotational_drag_in_spin, "rotational_drag_in_spin", "rotational drag in spin", "m^4",
     "C_r D about the centroid, body axes", true},
    {&DynamicCoefficients::wake_by_velocity, "wake_by_velocity", "wake by velocity", "m^4", "N_v, body axes", false},
    {&DynamicCoefficients::wake_by_turning, "wake_by_turning", "wake by turning", "m^4", "N_w, body axes", false},
};

/// Coefficients with the standard error of each.
struct IdentifiedCoefficients {
    DynamicCoefficients values;
    DynamicCoefficients standard_errors;  ///< without half-length and origin
};

/// What is wrong with the coefficients, such as "drag_in_motion is not symmetric": a number that is not
/// finite, a tensor that is not symmetric, a drag that is not positive semidefinite, a half-length that is not positive.
/// Empty where nothing is.
std::string fault_of(const DynamicCoefficients& coefficients);

}  // namespace samara
