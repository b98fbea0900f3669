#pragma once

#include <vector>

#include "samara/base/linear_algebra.hpp"
#include "samara/body/load_tables.hpp"

namespace samara {

/// Force and moment of the pressure in a steady tow, over rho U^2 A / 2 and rho U^2 A L / 2; body axes, about
/// the centroid of the volume.
struct PressureLoads {
    Vector3d force = Vector3d::Zero();
    Vector3d moment = Vector3d::Zero();
};

/// The loads of a steady tow as estimated from the potential flow over the surface, without CFD
/// (docs/surface-loads.md). Nondimensional with L = sqrt(S/pi) and A = pi L^2/4.
struct SurfaceLoads {
    int subdivisions = 1;  ///< of the octahedral map of body axes, as in LoadTables
    /// By the direction of the velocity relative to the fluid: node (row, column) of the map is
    /// pressure[row * (2 * subdivisions + 1) + column].
    std::vector<PressureLoads> pressure;
    /// Times the unit direction and a friction coefficient: the force of friction on the surface.
    Matrix3d friction_force = Matrix3d::Zero();
    Matrix3d friction_moment = Matrix3d::Zero();  ///< its moment likewise
};

/// The same as tables for Reynolds numbers from 1 to 1e5, with the friction of a laminar boundary layer,
/// 1.33 Re^-1/2 (Blasius), beside which Stokes' resistance stands throughout, k = epsilon = 0, and the
/// standard errors that such tables have beside those by CFD. `length`: L (m).
LoadTables as_tables(const SurfaceLoads& loads, double length);

}  // namespace samara
