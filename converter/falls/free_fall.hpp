#pragma once

#include <filesystem>
#include <string>

#include "converter/cases/case_plan.hpp"
#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// A free fall that is solved by full CFD, in the units of its case: lengths in units of L = sqrt(S/pi),
/// velocities of U, densities of the fluid's. The case's axes are `axes` in the body at the start, with the
/// origin at the centroid of the volume; they stay fixed while the body falls in a fluid at rest.
struct FreeFall {
    std::string name = "fall_00";  ///< of its folder
    std::string mesh = "mesh";     ///< the folder of its mesh, beside its own
    Closure closure = Closure::k_epsilon;
    double reynolds_number = 1.0;  ///< U L / nu

    double length = 1.0;                   ///< L (m)
    double speed = 1.0;                    ///< U (m/s), about the speed of the fall
    double fluid_density = 1.0;            ///< kg/m^3
    Matrix3d axes = Matrix3d::Identity();  ///< columns: the case's axes in body axes

    double volume = 0.0;                         ///< in L^3
    double mass = 0.0;                           ///< in rho L^3
    Vector3d center_of_mass = Vector3d::Zero();  ///< in L, from the centroid
    /// Principal axes of the inertia about the centre of mass, as columns, and the moments about them in rho
    /// L^5.
    Matrix3d principal_axes = Matrix3d::Identity();
    Vector3d principal_moments = Vector3d::Zero();
    Vector3d gravity = Vector3d::Zero();  ///< in U^2/L
    /// Velocity of the centre of mass (in U) and angular velocity (in U/L) at the first instant, while the
    /// fluid is at rest. The fluid takes its share of the momenta in the first steps, after which the body
    /// has its intended speed.
    Vector3d velocity = Vector3d::Zero();
    Vector3d angular_velocity = Vector3d::Zero();

    double duration = 0.0;                 ///< in L/U
    double time_step = 0.0;                ///< in L/U
    int outer_correctors = 1;              ///< alternating solutions of flow and motion in each step
    double acceleration_relaxation = 0.7;  ///< share of the new acceleration that is applied in each of them
    double field_interval = 0.0;           ///< in L/U, between flows that are kept for pictures; 0: none

    [[nodiscard]] double time_unit() const { return length / speed; }
    /// Returns the inertia about the centre of mass (in rho L^5).
    [[nodiscard]] Matrix3d inertia() const {
        return principal_axes * principal_moments.asDiagonal() * principal_axes.transpose();
    }
};

/// Return the fall as JSON, and read it from fall.json in the fall's folder. Reading throws Error, which
/// names the file, where it is missing or no JSON, or an entry is missing or invalid.
std::string free_fall_json(const FreeFall& fall);
FreeFall read_free_fall(const std::filesystem::path& folder);

}  // namespace samara
