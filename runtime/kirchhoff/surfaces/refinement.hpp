#pragma once

#include <cstddef>

#include "samara/core/surface/creases.hpp"

namespace samara {

/// A surface with the creases that it is known to have.
struct CreasedSurface {
    Surface surface;
    Creases creases;
};

/// The place at which an edge that runs away from a crease is cut, as a part of its length from the crease:
/// repeated refinement then grades triangles as the distance's square root, which the flow's potential, going
/// as the distance to a power of 1/2 (rim of a plate) to 2/3 (right angle), is resolved by in the second
/// order (Apel, Anisotropic Finite Elements, Teubner 1999, section 4).
inline constexpr double cut_towards_creases = 0.25;

/// Cuts each triangle in four on the same curved surface: at the middle of its edges, but at
/// cut_towards_creases from a crease. `surface` is of order 2, and so is the result, which follows the same
/// quadratic patches; creases are those of the given one.
CreasedSurface refined(const CreasedSurface& given);

/// Returns a coarser surface of order 1 whose vertices are some of the given corners: layers of vertices, no
/// two of them neighbours, are drawn into neighbours until at most `most_triangles` are left or nothing more
/// can go. Each layer is taken whole, so that a graded surface stays graded alike. Creases and corners stay:
/// a vertex that stands out of its neighbours by more than half the distance to the nearest is kept. Edges of
/// the result are creases where their triangles form an angle of more than sharp_angle between two vertices
/// of given creases, so that a smooth body stays one however coarse.
CreasedSurface coarsened(const CreasedSurface& given, std::size_t most_triangles);

}  // namespace samara
