#pragma once

#include <functional>

#include "samara/core/body/body.hpp"

namespace samara {

/// Boundary element methods for the Kirchhoff tensor; docs/explanation/added-mass.md derives both.
enum class KirchhoffMethod {
    automatic,           ///< chosen by the surface: curved triangles where it is smooth, else hypersingular
    curved_collocation,  ///< direct, quadratic on curved triangles: the fourth order on smooth bodies
    hypersingular,  ///< Galerkin, linear on flat triangles: for edges, thin bodies and very many triangles
};

/// Options of kirchhoff_tensor().
struct KirchhoffOptions {
    int threads = 0;         ///< 0: all cores; the result does not depend on it
    double tolerance = 0.0;  ///< relative tensor error that will do: the coarsest surface whose estimate is
                             ///< below it is taken; 0: as good as the surface's own triangles give
    KirchhoffMethod method = KirchhoffMethod::automatic;  ///< boundary elements
    std::function<void(double)> progress = {};            ///< called with the share of the work done, 0 to 1
};

/// Returns the Kirchhoff tensor (added mass) of a closed, outward surface in unbounded ideal fluid at rest:
/// 6x6, order (omega, v), about moments.centroid, in shape axes, for a fluid of 1 kg/m^3 (Lamb,
/// Hydrodynamics, 6th ed., art. 121-124). The surface may have several closed parts, which move together.
///
/// A smooth surface is solved on curved triangles: its own where it is of order 2, else those that its flat
/// ones stand for (rebuilt_surface). Surfaces with creases, and those much thinner than their triangles, are
/// solved with the hypersingular operator, on each triangle cut in four towards the creases, and extrapolated
/// to triangles of no size.
///
/// Where curved triangles, given or rebuilt, fold into each other, the surface is solved with straight edges,
/// and the difference of the volumes is among the errors.
///
/// error_estimate comes from the difference between two surfaces of different fineness, so that it covers
/// the elements and the surface's curvature; it cannot see details that the given triangles leave out of the
/// body. 1: nothing is known.
///
/// Throws Error, without a file name, where the surface is no body's: empty, inside out, open, with inverted,
/// repeated, overlapping or degenerate triangles, sheets that touch or a cavity. A tolerance out of reach of
/// the surface's triangles shows in error_estimate alone.
KirchhoffTensor kirchhoff_tensor(const Surface& surface, const VolumeMoments& moments,
                                 const KirchhoffOptions& options = {});

/// Returns the Kirchhoff tensor of the body's surface. Its error_estimate has the error of that surface
/// against the shape in it, where the body knows it (tensor_error_of).
KirchhoffTensor kirchhoff_tensor(const Body& body, const KirchhoffOptions& options = {});

}  // namespace samara
