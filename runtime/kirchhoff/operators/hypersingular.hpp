#pragma once

#include <functional>

#include "samara/core/surface/surface.hpp"
#include "samara/kirchhoff/operators/boundary_elements.hpp"
#include "samara/kirchhoff/panels/linear_elements.hpp"
#include "samara/kirchhoff/panels/single_layer_entries.hpp"

namespace samara {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Returns the dense single-layer matrix of the entries; each pair of triangles is integrated once.
RowMatrix dense_single_layer(const SingleLayerEntries& entries, int threads,
                             const std::function<void(double)>& progress = {});

/// Returns the dense hypersingular matrix <W v_j, v_i> = sum over triangles of curl v_i . V curl v_j
/// (Nedelec's form), whose null space is the constants on each component.
RowMatrix dense_hypersingular(const LinearElements& elements, const RowMatrix& single_layer, int threads);

/// Options of solve_hypersingular().
struct HypersingularOptions {
    /// The most nodes for which the matrix is factorised; above, V is compressed and the solver iterates.
    std::size_t most_dense_nodes = 1000;
    double compression = 1e-5;  ///< error of a compressed block, relative to its norm
    double tolerance = 1e-6;    ///< energy that the iteration may leave, relative to the tensor's entry
};

/// Computes the Kirchhoff tensor by linear Galerkin elements for the hypersingular equation W phi = -(1/2 +
/// D') g on flat triangles (docs/explanation/added-mass.md), in the form
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

/// Returns the potential of the fluid's velocity, grad phi, at each vertex of the surface, one row each, for
/// the six unit motions of the body, order omega then v, by the elements of solve_hypersingular(), whose
/// matrix is factorised whatever the number of nodes. The potential is known up to a constant on each
/// component of the surface. `surface` and errors: as for solve_hypersingular().
SixColumns unit_potentials(const Surface& surface, int threads);

}  // namespace samara
