#pragma once

#include <string>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// (Q/|v|)^2 at which half of what a steady translation lacks is there: small, since a body need not turn
/// fast beside its speed for its flow to be steady no more. Identified on the falls of docs/studies/falls,
/// which give 0.003 to 0.1. Where |v| and Q have changed places, half of the steady moment is gone.
inline constexpr double motion_onset = 0.03;

/// Over how long a way transport forms behind a body that starts in fluid at rest, over the body's extent
/// along it (docs/theory, "A wake that forms"; chosen in docs/studies/falls, "The start").
inline constexpr double wake_formation_lengths = 1.0;

/// Over how long a way the steady translation's own moment comes back behind a body that no longer swings,
/// over its extent along it. Usual: so that from rest it is there after the 2.3 extents that steady
/// translations by full CFD have in the median. Of bodies whose transport was identified from falls: these
/// lack the steady moment (docs/studies/falls, "The start"); where all axes are alike, as a cube's, transport
/// turns nothing and the steady moment is all there is.
inline constexpr double usual_settling_length = 0.8;
inline constexpr double settling_length_of_falls = 20.0;
inline constexpr double settling_length_of_alike_axes = 5.0;

/// What a free body feels beyond the tabulated loads of a steady translation (docs/theory, "Loads of a moving
/// body"); but for f none of it changes a steady translation without rotation. Body axes about the centroid
/// of the volume; rho the fluid's density, v and omega relative to the fluid, H = sqrt(|v|^2 + c^2
/// |omega|^2). Q is the tip speed c |omega| of the body's own turning: what turbulence turns is in the table
/// already. In still fluid they are one.
struct DynamicCoefficients {
    /// T (m^3), symmetric: separated flow adds the force rho omega x (T v) and the moment rho v x (T v),
    /// which together do no work. T = M, the added mass, takes the potential flow's own away.
    Matrix3d transport = Matrix3d::Zero();
    /// t: the same for the rest of the fluid's momenta, its angular momentum J omega + C v and the linear one
    /// C^T omega that turning makes; J, C: blocks of K_fluid. 1 takes the potential flow's own away.
    double rotational_transport = 0.0;
    /// f: what the steady solution of a steady translation misses of the flow around a free body, which is
    /// never steady: the tabulated force and moment are taken times f.
    double unsteady_factor = 1.0;
    /// Over how long a way, over the body's extent along it, the direction from which the fluid meets the
    /// body counts in its mean: as far as that is steady the steady moment is there.
    double settling_length = usual_settling_length;
    /// C_m A (m^2), symmetric and positive semidefinite: drag in motion, the force -rho/2 H s C_m A v with s
    /// = Q^2/(motion_onset |v|^2 + Q^2).
    Matrix3d drag_in_motion = Matrix3d::Zero();
    /// C_s A (m^2), likewise, of a body that turns fast: the force -rho/2 H s C_s A v with s =
    /// Q^2/(|v|^2 + Q^2).
    Matrix3d drag_in_spin = Matrix3d::Zero();
    /// C_w D (m^4), symmetric and positive semidefinite: turning, the moment -rho/2 H C_w D omega.
    Matrix3d rotational_drag = Matrix3d::Zero();
    /// C_r D (m^4), likewise, of a body that turns fast: the moment -rho/2 H s C_r D omega with the
    /// same s.
    Matrix3d rotational_drag_in_spin = Matrix3d::Zero();
    /// c (m): the body's half-length.
    double half_length = 0.0;
    std::string origin;  ///< where they come from, in words, for reports
};

/// A tensor among the coefficients, for what treats them all alike.
struct TensorOfMotion {
    Matrix3d DynamicCoefficients::*member;  ///< which tensor
    const char* name;                       ///< in files
    const char* title;                      ///< in reports
    const char* unit;                       ///< of its entries
    const char* meaning;                    ///< the formula's symbol
    bool is_drag;                           ///< and so positive semidefinite
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

/// Likewise of the plain numbers.
struct NumberOfMotion {
    double DynamicCoefficients::*member;  ///< which number
    const char* name;                     ///< in files
    const char* title;                    ///< in reports
    bool is_positive;                     ///< whether it may not be below zero
    bool is_late;                         ///< absent in files from before, which were identified without it
};
inline constexpr NumberOfMotion numbers_of_motion[] = {
    {&DynamicCoefficients::rotational_transport, "rotational_transport", "turning transport", false, false},
    {&DynamicCoefficients::unsteady_factor, "unsteady_factor", "unsteady factor", true, true},
    {&DynamicCoefficients::settling_length, "settling_ways", "settling ways", true, true},
};

/// Of which densities the falls were that coefficients come from, over the fluid's; zero: not known.
struct IdentifiedDensities {
    double lowest = 0.0;
    double highest = 0.0;
};

/// Coefficients with the standard error of each.
struct IdentifiedCoefficients {
    DynamicCoefficients values;           ///< as the falls say
    DynamicCoefficients standard_errors;  ///< without half-length and origin
    IdentifiedDensities densities;        ///< not known of files from before
};

/// How far a density (over the fluid's) lies outside those of the falls, as a ratio; 1 within them or where
/// they are not known.
double beyond(const IdentifiedDensities& densities, double density);

/// What is wrong with the coefficients, such as "drag_in_motion is not symmetric": a number that is not
/// finite, a tensor that is not symmetric, a drag that is not positive semidefinite, a half-length or factor
/// that is not positive. Empty where nothing is.
std::string error_of(const DynamicCoefficients& coefficients);

}  // namespace samara
