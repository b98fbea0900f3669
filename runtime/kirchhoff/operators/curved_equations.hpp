#pragma once

#include "samara/core/base/machine_memory.hpp"
#include "samara/kirchhoff/operators/boundary_elements.hpp"
#include "samara/kirchhoff/panels/curved_panels.hpp"
#include "samara/kirchhoff/solvers/block_solver.hpp"

namespace samara {

/// The discrete equations A phi' = b of curved panels, one row for each node: A = 1/2 - D, in single
/// precision apart from the diagonal, which is such that each row sums to 1 in double precision.
struct CurvedEquations {
    std::size_t count = 0;        ///< nodes
    std::size_t groups = 0;       ///< of nodes, as in panel_kernels
    LargeArray<float> rows;       ///< A without its diagonal, group after group
    Eigen::VectorXd diagonal;     ///< of A
    SixColumns right_hand_sides;  ///< -S (x cross n) for omega, -x for v
    double closure_error = 0.0;   ///< as in BoundaryElementResult

    /// A times six columns.
    [[nodiscard]] SixColumns multiply(const SixColumns& columns, int threads) const;
    [[nodiscard]] const float* group_rows(std::size_t group) const;
    [[nodiscard]] float* group_rows(std::size_t group);
};

/// The equations with integrals of the relative accuracy `tolerance` (PanelQuadrature).
CurvedEquations assemble_curved_equations(const CurvedPanels& panels, double tolerance,
                                          const BoundaryElementOptions& options);

}  // namespace samara
