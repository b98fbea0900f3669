#pragma once

#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// A face whose normal has at least this cosine to the direction belongs to the windward side, so that those
/// along the direction do, whatever the rounding, and a prism's silhouette runs along its lee edges.
inline constexpr double along_the_flow = -1e-6;

/// What a flow along a direction meets of a closed surface.
struct Silhouette {
    /// The share of the silhouette's length, as seen along the direction, that runs along sharp edges. An
    /// edge counts in full from 55 degrees between the normals of its faces on, and not at all up to 25
    /// degrees.
    double edge_share = 0.0;
    /// The volume over the projected area to the power of 3/2: 0 of a plate broadside, 1 of a cube.
    double depth = 0.0;
};

/// Returns the silhouette of the surface along each of the unit vectors. Flat triangles; any unit of length.
std::vector<Silhouette> silhouettes(const Surface& surface, const std::vector<Vector3d>& directions);

}  // namespace samara
