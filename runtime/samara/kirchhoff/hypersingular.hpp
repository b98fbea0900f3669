#pragma once

#include "samara/body/surface.hpp"
#include "samara/kirchhoff/boundary_elements.hpp"

namespace samara {

/// Solves for the six unit motions with the hypersingular operator on flat triangles, linear elements
/// (docs/theory-kirchhoff). `surface`: order 1, closed, outward, vertices merged, about the reference point,
/// in units in which its size is about 1.
BoundaryElementResult solve_hypersingular(const Surface& surface, const BoundaryElementOptions& options);

}  // namespace samara
