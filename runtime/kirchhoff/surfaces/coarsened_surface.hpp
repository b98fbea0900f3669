#pragma once

#include <cstddef>

#include "samara/kirchhoff/surfaces/refined_surface.hpp"

namespace samara {

/// A coarser surface of order 1 whose vertices are some of the given corners: layers of vertices, no two of
/// them neighbours, are drawn into neighbours until at most `most_triangles` are left or nothing more can go.
/// Each layer is taken whole, so that a graded surface stays graded alike. Creases and corners stay: a vertex
/// that stands out of its neighbours by more than half the distance to the nearest is kept. Edges of the
/// result are creases where they turn by more than sharp_angle between two vertices of given creases, so
/// that a smooth body stays one however coarse.
CreasedSurface coarsened(const CreasedSurface& given, std::size_t most_triangles);

}  // namespace samara
