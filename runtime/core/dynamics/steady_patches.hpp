#pragma once

#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/body.hpp"
#include "samara/core/body/dynamic_coefficients.hpp"

namespace samara {

/// A part of a body's surface, on which the steady load depends on its own velocity
/// (docs/explanation/moving-loads.md#patches).
struct SteadyPatch {
    Vector3d place = Vector3d::Zero();  ///< m, of its centre of area from that of the whole surface
    double share = 1.0;                 ///< of the whole area
    /// The force on its own faces in a steady translation, in units of rho U^2 A / 2, at each entry of the
    /// body's tables; empty where it bears its share of the whole body's.
    std::vector<Vector3d> force;
};

/// A surface divided into patches.
struct DividedSurface {
    std::vector<SteadyPatch> patches;
    /// R: of the whole's rotational drag D the part R D R^T acts within the patches; the rest, by the
    /// patches' own velocities, is in the steady force already.
    Matrix3d rotation_within = Matrix3d::Identity();
    /// the distance of faces from their patch's centre, relative to that from the whole's centre
    double reach_within = 1.0;
};

/// Returns the body's surface, or that of its surface loads where it has any, divided into `count` patches
/// (surface_patches), each of which bears its share of the whole's steady translation.
DividedSurface divided_surface(const Body& body, int count);

/// Returns the body's surface divided into `count` patches, which share out the steady translation of
/// `tables` by the pressures on the patches where the body has surface loads. Together the forces are the
/// tables'; each patch has a drag.
DividedSurface divided_surface(const Body& body, const LoadTables& tables, int count);

/// Returns the part of a rotational drag (m^4) that acts within the patches.
Matrix3d within_patches(const Matrix3d& rotational_drag, const DividedSurface& divided);

/// Returns the coefficients of a body in patches: their rotational drag is that within the patches.
DynamicCoefficients within_patches(DynamicCoefficients coefficients, const DividedSurface& divided);

}  // namespace samara
