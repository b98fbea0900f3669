#pragma once

#include <numbers>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/load_tables.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// The two constants of the pressure, which all bodies share, chosen on the reference falls
/// (docs/explanation/loads-without-a-bake.md).
struct SurfacePressure {
    /// in units of rho U^2 / 2: the pressure behind the body, and the least anywhere: a flow that would have
    /// to go below separates
    double base = -0.54;
    /// the sine of the angle between flow and face at which the face is wholly in the wake
    double separation_sine = 0.38;
};

/// Force and moment of the pressure in a steady translation, in units of rho U^2 A / 2 and rho U^2 A L / 2;
/// body axes, about the centroid of the volume.
struct PressureLoads {
    Vector3d force = Vector3d::Zero();   ///< in units of rho U^2 A / 2
    Vector3d moment = Vector3d::Zero();  ///< in units of rho U^2 A L / 2
};

/// The potential flow over the surface, from which the loads of a steady translation are estimated without
/// CFD (docs/explanation/loads-without-a-bake.md). Nondimensional with L = sqrt(S/pi) and A = pi L^2/4.
struct SurfaceLoads {
    Surface surface;  ///< flat triangles, in units of L about the centroid of the volume, body axes
    /// At each vertex the potentials of the unit velocities along the three axes, in units of U L.
    std::vector<Vector3d> potentials;
};

/// Returns the loads of the pressure by the direction of the velocity relative to the fluid, at each node of
/// the octahedral map of body axes, row by row as in LoadTables: the potential flow's pressure where the flow
/// is attached, at least the base pressure, and the base pressure where the surface faces away from it.
std::vector<PressureLoads> pressure_loads(const SurfaceLoads& loads, int subdivisions,
                                          const SurfacePressure& pressure = {});

/// Returns the loads as tables for Reynolds numbers from 1 to 1e5: the pressure, the friction of a laminar
/// boundary layer, 1.33 Re^-1/2 (Blasius), Stokes' resistance throughout, k = epsilon = 0, and the standard
/// errors relative to tables by CFD. `length`: L (m).
LoadTables as_tables(const SurfaceLoads& loads, double length, const SurfacePressure& pressure = {});

/// A triangle of a surface in the potential flow of a steady translation, in units of L about the centroid.
struct SurfaceElement {
    Vector3d place = Vector3d::Zero();   ///< its centre
    Vector3d normal = Vector3d::Zero();  ///< outward; zero where it has no area
    double area = 0.0;                   ///< in units of L^2
    /// The fluid's velocity along the surface, as seen from the body: a column for each unit velocity of the
    /// body.
    Matrix3d surface_velocity = Matrix3d::Zero();
};

/// Returns the elements of the surface, one for each triangle.
std::vector<SurfaceElement> surface_elements(const SurfaceLoads& loads);

/// Returns the pressure on the element, in units of rho U^2 / 2, where the body moves along the unit vector
/// `direction` (docs/explanation/loads-without-a-bake.md, "The steady translation").
double pressure_on(const SurfaceElement& element, const Vector3d& direction, const SurfacePressure& pressure);

/// The reference area A relative to L^2.
inline constexpr double reference_area_over_length_square = std::numbers::pi / 4.0;

}  // namespace samara
