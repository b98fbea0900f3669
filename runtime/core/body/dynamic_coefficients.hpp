#pragma once

#include <string>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// The value of (Q/|v|)^2 at which half of what a steady translation lacks is there. It is small: the flow of
/// a body is no longer steady when it rotates slowly beside its speed. Identified on the falls of
/// docs/studies/falls, which give 0.003 to 0.1. At (|v|/Q)^2 of this value half of the steady moment is gone.
inline constexpr double motion_onset = 0.03;

/// The distance over which transport forms behind a body that starts in fluid at rest, relative to the body's
/// extent along its path (docs/explanation/moving-loads.md; chosen in docs/studies/falls,
/// "The start").
inline constexpr double wake_formation_lengths = 1.0;

/// The distance over which the steady translation's own moment returns behind a body that no longer swings,
/// relative to its extent along its path. The usual one: from rest the moment is there after 2.3 extents, the
/// median of steady translations by full CFD. Bodies whose transport was identified from falls lack the
/// steady moment (docs/studies/falls, "The start"). Where all axes are alike, as a cube's, transport causes
/// no moment and the steady moment is all there is.
inline constexpr double usual_settling_length = 0.8;
inline constexpr double settling_length_of_falls = 20.0;
inline constexpr double settling_length_of_alike_axes = 5.0;

/// The coefficients of the loads of a free body beyond the tabulated ones of a steady translation
/// (docs/explanation/moving-loads.md). None but f changes a steady translation without rotation.
/// Body axes about the centroid of the volume; rho is the fluid's density, v and omega are relative to the
/// fluid, H = sqrt(|v|^2 + c^2 |omega|^2). Q is the tip speed c |omega| of the body's own rotation: the
/// effect of turbulence is in the table already. In still fluid both rotations are one.
struct DynamicCoefficients {
    /// T (m^3), symmetric: separated flow adds the force rho omega x (T v) and the moment rho v x (T v),
    /// which together do no work. T = M, the added mass, cancels that of the potential flow.
    Matrix3d transport = Matrix3d::Zero();
    /// t: the share of transport for the rest of the fluid's momenta, its angular momentum J omega + C v and
    /// the linear momentum C^T omega of a rotation; J, C: blocks of K_fluid. 1 cancels that of the potential
    /// flow.
    double rotational_transport = 0.0;
    /// f: what the steady solution of a steady translation misses of the flow around a free body, which is
    /// never steady: the tabulated force and moment are taken times f.
    double unsteady_factor = 1.0;
    /// The distance, relative to the body's extent along its path, over which the direction of the relative
    /// velocity is averaged: where that direction is steady the steady moment is there.
    double settling_length = usual_settling_length;
    /// C_m A (m^2), symmetric and positive semidefinite: drag in motion, the force -rho/2 H s C_m A v with s
    /// = Q^2/(motion_onset |v|^2 + Q^2).
    Matrix3d drag_in_motion = Matrix3d::Zero();
    /// C_s A (m^2), symmetric and positive semidefinite: drag in fast rotation, the force -rho/2 H s C_s A v
    /// with s = Q^2/(|v|^2 + Q^2).
    Matrix3d drag_in_spin = Matrix3d::Zero();
    /// C_w D (m^4), symmetric and positive semidefinite: drag of rotation, the moment -rho/2 H C_w D omega.
    Matrix3d rotational_drag = Matrix3d::Zero();
    /// C_r D (m^4), symmetric and positive semidefinite: drag of fast rotation, the moment -rho/2 H s C_r D
    /// omega with s = Q^2/(|v|^2 + Q^2).
    Matrix3d rotational_drag_in_spin = Matrix3d::Zero();
    /// c (m): the body's half-length.
    double half_length = 0.0;
    /// Two numbers of bodies by the loads of their surface, which no file holds. a: with a laminar boundary
    /// layer the rotational drag is C_w (1 + a sqrt(1000 nu / (H L))).
    double laminar_rotational_drag = 0.0;
    /// b: of the force omega x v of T's isotropic part, the spin lift, the share |v|^2/(|v|^2 + b Q^2) is
    /// there.
    double spin_lift_onset = 0.0;
    std::string origin;  ///< where they come from, in words, for reports
};

/// Describes a tensor among the coefficients, for code that treats them all alike.
struct TensorOfMotion {
    Matrix3d DynamicCoefficients::*member;  ///< which tensor
    const char* name;                       ///< in files
    const char* title;                      ///< in reports
    const char* unit;                       ///< of its entries
    const char* meaning;                    ///< the formula's symbol
    bool is_drag;                           ///< whether it must be positive semidefinite
};
inline constexpr TensorOfMotion tensors_of_motion[] = {
    {&DynamicCoefficients::transport, "transport", "transport", "m^3", "T, body axes", false},
    {&DynamicCoefficients::drag_in_motion, "drag_in_motion", "drag in motion", "m^2", "C_m A, body axes",
     true},
    {&DynamicCoefficients::drag_in_spin, "drag_in_spin", "drag in spin", "m^2", "C_s A, body axes", true},
    {&DynamicCoefficients::rotational_drag, "rotational_drag", "rotational drag", "m^4",
     "C_w D about the centroid, body axes", true},
    {&DynamicCoefficients::rotational_drag_in_spin, "rotational_drag_in_spin", "rotational drag in spin",
     "m^4", "C_r D about the centroid, body axes", true},
};

/// Describes a scalar among the coefficients, for code that treats them all alike.
struct NumberOfMotion {
    double DynamicCoefficients::*member;  ///< which number
    const char* name;                     ///< in files
    const char* title;                    ///< in reports
    bool is_positive;                     ///< whether it must not be negative
    bool is_late;                         ///< whether older files lack it
    const char* older_name = "";          ///< its name in older files, where that was another
};
inline constexpr NumberOfMotion numbers_of_motion[] = {
    {&DynamicCoefficients::rotational_transport, "rotational_transport", "rotational transport", false,
     false},
    {&DynamicCoefficients::unsteady_factor, "unsteady_factor", "unsteady factor", true, true},
    {&DynamicCoefficients::settling_length, "settling_length", "settling length", true, true,
     "settling_ways"},
};

/// The range of the densities of the falls that coefficients are identified from, relative to the fluid's;
/// zero where not known.
struct IdentifiedDensities {
    double lowest = 0.0;   ///< the least density, relative to the fluid's
    double highest = 0.0;  ///< the greatest density, relative to the fluid's
};

/// Coefficients with the standard error of each.
struct IdentifiedCoefficients {
    DynamicCoefficients values;           ///< as identified from the falls
    DynamicCoefficients standard_errors;  ///< without half-length and origin
    IdentifiedDensities densities;        ///< older files lack them
};

/// Returns the ratio by which a density (relative to the fluid's) lies outside those of the falls; 1 within
/// them or where they are not known.
double beyond(const IdentifiedDensities& densities, double density);

/// Returns what is wrong with the coefficients, such as "drag_in_motion is not symmetric": a number that is
/// not finite, a tensor that is not symmetric, a drag that is not positive semidefinite, a half-length or
/// factor that is not positive. Empty where nothing is.
std::string error_of(const DynamicCoefficients& coefficients);

}  // namespace samara
