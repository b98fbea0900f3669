#pragma once

#include <numbers>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/load_tables.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// The two numbers of the pressure that all bodies share, chosen on the reference falls
/// (docs/surface-loads.md).
struct SurfacePressure {
    double base = -0.54;  ///< over rho U^2 / 2, behind the body, and the least anywhere: a flow that
                          ///< would have to go below leaves the surface
    double separation_sine = 0.38;  ///< of the angle between flow and face at which the face is wholly in the
                                    ///< wake
};

/// Force and moment of the pressure in a steady translation, over rho U^2 A / 2 and rho U^2 A L / 2; body
/// axes, about the centroid of the volume.
struct PressureLoads {
    Vector3d force = Vector3d::Zero();
    Vector3d moment = Vector3d::Zero();
};

/// What the loads of a steady translation are estimated from without CFD (docs/surface-loads.md): the
/// potential flow over the surface. Nondimensional with L = sqrt(S/pi) and A = pi L^2/4.
struct SurfaceLoads {
    Surface surface;  ///< flat triangles, in lengths of L about the centroid of the volume, body axes
    /// At each vertex the potentials of the unit velocities along the three axes, over U L.
    std::vector<Vector3d> potentials;
};

/// The loads of the pressure by the direction of the velocity relative to the fluid, at each node of the
/// octahedral map of body axes, row by row as in LoadTables: the flow's pressure where it is attached, at
/// least the base pressure, and the base pressure where the surface turns away from it.
std::vector<PressureLoads> pressure_loads(const SurfaceLoads& loads, int subdivisions,
                                          const SurfacePressure& pressure = {});

/// The loads as tables for Reynolds numbers from 1 to 1e5, with the friction of a laminar boundary layer,
/// 1.33 Re^-1/2 (Blasius), beside which Stokes' resistance stands throughout, k = epsilon = 0, and the
/// standard errors that such tables have beside those by CFD. `length`: L (m).
LoadTables as_tables(const SurfaceLoads& loads, double length, const SurfacePressure& pressure = {});

/// A triangle of a surface in the potential flow of a steady translation, in lengths of L about the centroid.
struct SurfaceElement {
    Vector3d place = Vector3d::Zero();   ///< its centre
    Vector3d normal = Vector3d::Zero();  ///< outward; zero where it has no area
    double area = 0.0;
    /// A column for each of the body's unit velocities: the fluid's velocity along the surface, as seen from
    /// the body.
    Matrix3d surface_velocity = Matrix3d::Zero();
};

/// One for each triangle.
std::vector<SurfaceElement> surface_elements(const SurfaceLoads& loads);

/// The pressure on the element over rho U^2 / 2 where the body moves along the unit vector `direction`
/// (docs/surface-loads.md, "The steady translation").
double pressure_on(const SurfaceElement& element, const Vector3d& direction, const SurfacePressure& pressure);

/// A over L^2.
inline constexpr double reference_area_over_length_square = std::numbers::pi / 4.0;

}  // namespace samara
