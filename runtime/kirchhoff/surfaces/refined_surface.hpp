#pragma once

#include "samara/core/surface/creases.hpp"

namespace samara {

/// A surface with the creases that it is known to have.
struct CreasedSurface {
    Surface surface;
    Creases creases;
};

/// Where an edge that runs away from a crease is cut, as a part of its length from the crease: repeated
/// refinement then grades triangles as the distance's square root, which the flow's potential, going as the
/// distance to a power of 1/2 (rim of a plate) to 2/3 (right angle), is resolved by in the second order
/// (Apel, Anisotropic Finite Elements, Teubner 1999, section 4).
inline constexpr double cut_towards_creases = 0.25;

/// Each triangle cut in four on the same curved surface: at the middle of its edges, but at
/// cut_towards_creases from a crease. `surface` is of order 2, and so is the result, which follows the same
/// quadratic patches; creases are those of the given one.
CreasedSurface refined(const CreasedSurface& given);

}  // namespace samara
