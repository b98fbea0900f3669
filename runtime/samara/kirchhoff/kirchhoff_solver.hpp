#pragma once

#include <functional>

#include "samara/body/body.hpp"

namespace samara {

/// The largest number of flat triangles that are solved for: the matrix then takes 3.2 GB.
inline constexpr std::size_t most_panels = 20000;

struct KirchhoffOptions {
    int threads = 0;                            ///< 0: all cores; the result does not depend on it
    std::function<void(double)> progress = {};  ///< called with the share of the work done, 0 to 1
};

/// The Kirchhoff tensor (added mass) of a closed, outward surface in unbounded ideal fluid at rest: 6x6,
/// order (omega, v), about moments.centroid, in shape axes, for a fluid of 1 kg/m^3 (Lamb, Hydrodynamics,
/// 6th ed., art. 121-124).
///
/// Direct boundary elements with one unknown on each flat triangle, second order in their size; the
/// derivation is in docs/theory-kirchhoff. Each triangle of an order-2 surface becomes four.
///
/// error_estimate comes from a second solve on a coarser surface whose vertices are some of the given ones
/// (the corners of an order-2 surface; else about half of the triangles, a quarter where edges turn by more
/// than a radian), so that it covers the flatness of the triangles as well as the elements' error. It takes
/// the error to fall with the first power of the triangles' size, which on smooth bodies is about three times
/// too careful, and with the power 2/3 where there are creases. Where the coarser surface is of no use (a box
/// of twelve triangles, a thin plate), each triangle is cut in four instead: the result is then that of the
/// finer surface, and the flatness is estimated from the volumes. The estimate cannot see what the given
/// surface itself leaves out of the body. 1: nothing is known.
///
/// Throws Error, without a file name, where the surface is empty, turned inside out, open, has flipped,
/// repeated, overlapping or degenerate triangles, or more than most_panels of them.
KirchhoffTensor kirchhoff_tensor(const Surface& surface, const VolumeMoments& moments,
                                 const KirchhoffOptions& options = {});

}  // namespace samara
