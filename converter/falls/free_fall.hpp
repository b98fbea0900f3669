#pragma once

#include <filesystem>
#include <string>

#include "converter/cases/case_plan.hpp"
#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// A free fall that is solved by full CFD, in the units of its case: lengths over L = sqrt(S/pi), velocities
/// over U, densities over the fluid's. The case's axes are those of `axes` in the body at the start, about
/// the centroid of the volume; they stay there while the body falls in a fluid at rest.
struct FreeFall {
    std::string name = "fall_00";  ///< of its folder
    std::string mesh = "mesh";     ///< the folder of its mesh, beside its own
    Closure closure = Closure::k_epsilon;
    double reynolds_number = 1.0;  ///< U L / nu

    double length = 1.0;                   ///< L (m)
    double speed = 1.0;                    ///< U (m/s), about the speed at which the body falls
    double fluid_density = 1.0;            ///< kg/m^3
    Matrix3d axes = Matrix3d::Identity();  ///< columns: the case's axes in body axes

    double volume = 0.0;                         ///< over L^3
    double mass = 0.0;                           ///< over rho L^3
    Vector3d center_of_mass = Vector3d::Zero();  ///< over L, from the centroid
    /// Of the inertia about the centre of mass: columns, and the moments along them over rho L^5.
    Matrix3d principal_axes = Matrix3d::Identity();
    Vector3d principal_moments = Vector3d::Zero();
    Vector3d gravity = Vector3d::Zero();  ///< over U^2/L
    /// Of the centre of mass, over U, and over U/L: in the first instant, while the fluid is at rest. The
    /// fluid takes its share of the momenta in the first steps, which leaves the body at the speed it is to
    /// have.
    Vector3d velocity = Vector3d::Zero();
    Vector3d angular_velocity = Vector3d::Zero();

    double duration = 0.0;                 ///< over L/U
    double time_step = 0.0;                ///< over L/U
    int outer_correctors = 1;              ///< solutions of flow and motion in turn in each step
    double acceleration_relaxation = 0.7;  ///< share of the new acceleration that is taken in each of them
    double field_interval = 0.0;  ///< over L/U: from one flow that is kept for pictures to the next; 0: none

    [[nodiscard]] double time_unit() const { return length / speed; }
    /// Over rho L^5, about the centre of mass.
    [[nodiscard]] Matrix3d inertia() const {
        return principal_axes * principal_moments.asDiagonal() * principal_axes.transpose();
    }
};

/// Writes the fall as JSON, and reads it: fall.json in the fall's folder. Reading throws Error, which names
/// the file, where it is missing, is no JSON, or an entry is missing or breaks a rule.
std::string free_fall_json(const FreeFall& fall);
FreeFall read_free_fall(const std::filesystem::path& folder);

}  // namespace samara
