#pragma once

#include "samara/body/surface.hpp"

namespace samara {

/// The coarse flat triangles as curved ones of order 2 whose edge nodes lie on the fine surface, near the
/// middles of the edges, on the side that looks the same way. `coarse`: of order 1, its corners are vertices
/// of the fine surface; `fine`: of order 2. Triangles that would fold keep straight edges.
Surface drawn_onto(const Surface& coarse, const Surface& fine, int threads = 0);

/// The surface of order 2 with straight edges, for both their triangles, wherever a curved triangle folds.
Surface without_folds(Surface surface);

}  // namespace samara
