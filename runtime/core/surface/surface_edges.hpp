#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "samara/core/surface/surface.hpp"

namespace samara {

/// One triangle's use of an edge.
struct EdgeUse {
    std::int32_t low = 0;   ///< the edge's vertex of the smaller index
    std::int32_t high = 0;  ///< the edge's other vertex
    std::int32_t triangle = 0;
    std::int32_t side = 0;  ///< the triangle's side from corner `side` to the next corner
    bool forward = true;    ///< whether the triangle runs along the edge from low to high
};

/// Returns all sides of all triangles, those of the same edge one after the other.
std::vector<EdgeUse> edge_uses(const Surface& surface);

/// Cuts the sorted uses into one run for each edge.
std::vector<std::span<const EdgeUse>> edges_of(const std::vector<EdgeUse>& uses);

/// Returns for each triangle and side the triangle on the other side of the edge; -1 where the edge is not
/// used by exactly two.
std::vector<std::array<std::int32_t, 3>> neighbours(const Surface& surface);

/// Reverses triangle t: its corners and edge nodes run in the other direction.
void reverse_triangle(Surface& surface, std::size_t triangle);

/// A piece of the surface that is connected over edges.
struct Component {
    std::vector<std::int32_t> triangles;  ///< the first is the reference of `against`
    std::vector<std::int32_t> against;    ///< those oriented opposite to the first
};

/// Returns the pieces, in the order of their first triangle. Only edges used by exactly two triangles
/// connect.
std::vector<Component> components(const Surface& surface);

/// Returns the volume (m^3) that a closed component encloses: negative where it is inside out. Flat
/// triangles.
double enclosed_volume(const Surface& surface, const Component& component);

/// Returns for each component the number of components that it lies within: 0 for outer ones, 1 for cavities.
/// All must be closed.
std::vector<int> nesting_depths(const Surface& surface, const std::vector<Component>& pieces);

/// Reverses triangles so that the closed surface faces outwards: away from the matter, which is where the
/// depth of nesting is odd. For surfaces whose orientation carries no meaning, such as those of CAD geometry.
void orient_outwards(Surface& surface);

}  // namespace samara
