#pragma once

#include <cstddef>
#include <functional>

#include "samara/core/surface/surface.hpp"

namespace samara {

/// The sound surface of order 1 with about `wanted` triangles, of which the vertices are some of the given
/// ones: vertices are drawn into neighbours where that moves the surface least, until no more than `wanted`
/// triangles are left or no vertex can go. Vertices on sharp edges (40 degrees) go along these alone, where
/// such edges meet they stay; no triangle turns by more than 60 degrees, and the surface keeps its topology:
/// closed stays closed, pieces stay apart. The measure is the mean square distance from the planes of all the
/// triangles that a vertex has taken over. Garland and Heckbert, Surface Simplification Using Quadric Error
/// Metrics, SIGGRAPH 1997; in layers of vertices that are no neighbours, so that a million triangles take
/// seconds.
///
/// meshoptimizer 0.18 is faster, but folds some triangles onto each other and makes others without area in
/// flat places. `progress` is called with the share of the work done, 0 to 1. The result does not depend on
/// the number of threads.
Surface reduced(const Surface& surface, std::size_t wanted, const std::function<void(double)>& progress = {});

}  // namespace samara
