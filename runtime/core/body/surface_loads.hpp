#pragma once

#include <numbers>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/load_tables.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

struct Silhouette;

/// The constants of the pressure, which all bodies share, in units of rho U^2 / 2: chosen on steady loads by
/// CFD (docs/explanation/loads-without-a-bake.md).
struct SurfacePressure {
    /// Behind bodies whose silhouette is smooth: of a sphere at the Reynolds number 1e5. Tables have a
    /// sphere's at each of theirs.
    double smooth_base = -0.51;
    double edge_base = -0.76;     ///< behind bodies whose silhouette runs along sharp edges
    double smooth_floor = -0.68;  ///< the least of faces that face the flow, of a smooth silhouette
    double edge_floor = -0.17;    ///< likewise, of one along sharp edges
    /// The share of the base pressure that the flow recovers behind sharp edges of a body without end.
    double recovery = 0.43;
};

/// The turbulence of the wake, which all bodies share: chosen by the scatter of measured falls
/// (docs/explanation/loads-without-a-bake.md).
struct SurfaceWake {
    /// k over U^2 from the Reynolds number 1000 on; it fades to 0 at 100.
    double turbulent_kinetic_energy = 0.09;
    double dissipation_over_energy = 0.65;  ///< epsilon L / U over k
};

/// The pressure of separated flow in one direction, in units of rho U^2 / 2.
struct SeparatedPressure {
    double base = 0.0;   ///< in the wake
    double floor = 0.0;  ///< the least of faces that face the flow
};

/// Returns the pressure of separated flow behind a silhouette.
SeparatedPressure separated_pressure(const Silhouette& silhouette, const SurfacePressure& pressure = {});

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
/// the octahedral map of body axes, row by row as in LoadTables: the potential flow's pressure where the
/// surface faces the flow, and the base pressure behind it, at the Reynolds number 1e5.
std::vector<PressureLoads> pressure_loads(const SurfaceLoads& loads, int subdivisions,
                                          const SurfacePressure& pressure = {});

/// Returns the loads as tables for Reynolds numbers from 1 to 1e5: the pressure, the friction of a laminar
/// boundary layer, 1.33 Re^-1/2 (Blasius), Stokes' resistance throughout, the turbulence of `wake` in all
/// directions, and the standard errors relative to tables by CFD. The base pressure of a smooth silhouette is
/// such that a sphere has its measured drag (Brown and Lawler, J. Env. Eng. 129, 222, 2003). `length`: L (m).
LoadTables as_tables(const SurfaceLoads& loads, double length, const SurfacePressure& pressure = {},
                     const SurfaceWake& wake = {});

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
/// `direction` and the separated flow has that pressure (docs/explanation/loads-without-a-bake.md, "The
/// steady translation").
double pressure_on(const SurfaceElement& element, const Vector3d& direction,
                   const SeparatedPressure& separated);

/// The reference area A relative to L^2.
inline constexpr double reference_area_over_length_square = std::numbers::pi / 4.0;

}  // namespace samara
