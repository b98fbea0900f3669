#pragma once

#include "samara/core/body/body.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// How far `mesh` is from `shape`: distances both ways, at some thousand points of each, volume and area.
/// Both are closed and welded, of either order. The faceting is left at 0.
ShapeError shape_error(const Surface& shape, const Surface& mesh);

/// What lies between facets and the smooth shape through their vertices.
struct Smoothing {
    double volume = 0.0;  ///< the relative change of the volume from the one to the other
    double between =
        0.0;  ///< the volume between the two, also where it is lost, over that of the body; at most 1
};

/// Estimates the smoothing of a closed and welded surface of order 1: at each edge where two facets meet at
/// less than the angle of a crease, the smooth shape is the arc of a circle over the narrower one.
Smoothing smoothing_of(const Surface& flat);

/// By how much a mesh misses its shape, as a share of what is allowed: 0.5 % of volume and of the diagonal of
/// the shape's box as distance, 2 % of area. `smoothing`: the relative change of volume and area up to which
/// the mesh may have rounded facets off.
double miss_of(const ShapeError& error, double smoothing = 0.0);

}  // namespace samara
