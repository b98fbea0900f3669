#pragma once

#include "samara/core/body/body.hpp"

namespace samara {

/// Solves the potential flow over a closed and outward `surface` in steady translations (unit_potentials) on
/// its flat triangles, or of a finer surface on those of a coarser one. The result does not depend on
/// `threads` (0: all cores). Throws Error where the equations cannot be solved.
SurfaceLoads surface_loads(const Surface& surface, const VolumeMoments& moments, int threads = 0);

}  // namespace samara
