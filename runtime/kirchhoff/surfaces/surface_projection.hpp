#pragma once

#include "samara/core/surface/surface.hpp"

namespace samara {

/// The coarse flat triangles as curved ones of order 2 whose edge nodes lie on the fine surface, near the
/// middles of the edges, on the side that looks the same way. `coarse`: of order 1;
/// `fine`: of order 2. Triangles that would fold keep straight edges. The result does not depend on `threads`
/// (0: all cores).
Surface drawn_onto(const Surface& coarse, const Surface& fine, int threads = 0);

}  // namespace samara
