#pragma once

#include "samara/core/surface/surface.hpp"
#include "samara/kirchhoff/operators/boundary_elements.hpp"

namespace samara {

/// Returns the Kirchhoff tensor of a body by direct collocation with a quadratic potential on curved six-node
/// triangles, fourth order in their size on smooth bodies (docs/explanation/added-mass.md). One unknown a
/// vertex.
///
/// `surface` is of order 2, closed and outward; coordinates are from the reference point and in units in
/// which its size is about 1. Throws Error at a degenerate triangle.
BoundaryElementResult solve_curved_collocation(const Surface& surface, const BoundaryElementOptions& options);

}  // namespace samara
