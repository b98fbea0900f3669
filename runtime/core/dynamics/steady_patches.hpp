#pragma once

#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/body.hpp"
#include "samara/core/body/dynamic_coefficients.hpp"

namespace samara {

/// A part of a body's surface, which meets the flow with its own velocity (docs/theory, "Patches").
struct SteadyPatch {
    Vector3d place = Vector3d::Zero();  ///< m, of its centre of area from that of the whole surface
    double share = 1.0;                 ///< of the whole area
    /// The force on its own faces in a steady translation, over rho U^2 A / 2, at each entry of the body's
    /// tables; none where it feels its share of the whole body's.
    std::vector<Vector3d> force;
};

/// A surface in patches.
struct DividedSurface {
    std::vector<SteadyPatch> patches;
    /// The rotational drag that is left within the patches is R D R^T of the whole's D: what a patch meets by
    /// its own velocity is in the steady force already.
    Matrix3d rotation_within = Matrix3d::Identity();
    double reach_within = 1.0;  ///< how far faces are from their patch's centre, over that from the whole's
};

/// Divides the body's surface, that of its surface loads where it has any, into `count` patches
/// (surface_patches), each of which feels its share of the whole's steady translation.
DividedSurface divided_surface(const Body& body, int count);

/// As divided_surface, and shares out the steady translation of `tables` by the pressures on the patches
/// where the body has surface loads. Together the forces are the tables'; each has a drag.
DividedSurface divided_surface(const Body& body, const LoadTables& tables, int count);

/// A rotational drag (m^4) of which what turns within the patches is left.
Matrix3d within_patches(const Matrix3d& rotational_drag, const DividedSurface& divided);

/// The coefficients of a body in patches: of its turning they know what is left within the patches.
DynamicCoefficients within_patches(DynamicCoefficients coefficients, const DividedSurface& divided);

}  // namespace samara
