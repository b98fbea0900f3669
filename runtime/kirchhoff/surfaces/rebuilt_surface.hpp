#pragma once

#include "samara/core/surface/creases.hpp"

namespace samara {

/// Returns the curved surface that flat triangles approximate: order 2, the same corners, with the middle
/// node of each edge where polynomials of up to the third degree through the vertices around its two ends put
/// it (osculating jets: Cazals and Pouget, Comput. Aided Geom. Des. 22(2), 2005), an error of the fourth
/// power of the edge's length on a smooth surface. Vertices beyond a crease do not count, and the creases
/// themselves are curves through their own vertices, broken where they bend by more than sharp_angle or
/// branch. Where the vertices do not determine a node well, it lies on the straight edge.
///
/// `flat` is of order 1, closed, with its vertices welded; `creases` are its own.
Surface rebuilt_surface(const Surface& flat, const Creases& creases, int threads = 0);

}  // namespace samara
