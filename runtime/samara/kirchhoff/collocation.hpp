#pragma once

#include <functional>

#include "samara/base/linear_algebra.hpp"
#include "samara/kirchhoff/panels.hpp"

namespace samara {

/// What one solve gives, in units of Panels::length.
struct CollocationResult {
    Matrix6d tensor;             ///< not symmetrised
    double closure_fault = 0.0;  ///< how far the solid angles of the panels, seen from one, are from their
                                 ///< sum on a closed surface, as a share of the full solid angle; the largest
};

/// Solves for the six unit motions by constant direct collocation (docs/theory-kirchhoff). Where the closure
/// fault is above `most_closure_fault`, the tensor is left zero.
CollocationResult solve_collocation(const Panels& panels, double most_closure_fault, int threads,
                                    const std::function<void(double)>& progress);

}  // namespace samara
