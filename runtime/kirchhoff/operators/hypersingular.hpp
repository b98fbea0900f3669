#pragma once

#include "samara/core/surface/surface.hpp"
#include "samara/kirchhoff/operators/boundary_elements.hpp"
#include "samara/kirchhoff/panels/linear_elements.hpp"

namespace samara {

/// How solve_hypersingular solves for its unknowns.
struct HypersingularOptions {
    /// Up to as many nodes the matrix is factorised; above, V is compressed and the solver iterates.
    std::size_t most_dense_nodes = 1000;
    double compression = 1e-5;  ///< error of a compressed block, relative to its norm
    double tolerance = 1e-6;    ///< of the iteration: the energy that is left, relative to the tensor's entry
};

/// The Kirchhoff tensor by linear Galerkin elements for the hypersingular equation W phi = -(1/2 + D') g on
/// flat triangles (docs/theory-kirchhoff), in the form
///   K_ab = <g_a, S g_b> + b_a^T W^-1 b_b,    b_a[i] = <(1/2 + D') g_a, v_i>,
/// a sum of two positive semidefinite forms however thin the body is. It converges from below where the
/// surface is kept and the triangles shrink.
///
/// `surface` is of order 1, closed, outward, its vertices welded, about the reference point, in units in
/// which its size is about 1; it may have several components, and faces as close to each other as one likes,
/// but not through each other. Throws Error at a triangle without an area, and where the equations cannot be
/// solved, which happens on surfaces that are not closed or cross themselves.
BoundaryElementResult solve_hypersingular(const Surface& surface, const BoundaryElementOptions& options,
                                          const HypersingularOptions& how = {});

/// The potential of the fluid's velocity, grad phi, at each vertex of the surface, a row each, for the six
/// unit motions of the body, order omega then v: the same elements, whose matrix is factorised whatever the
/// count of nodes. Of each component of the surface up to a constant. Units and errors as above.
SixColumns unit_potentials(const Surface& surface, int threads);

}  // namespace samara
