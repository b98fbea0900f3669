#pragma once

#include <map>

#include "samara/core/surface/surface.hpp"
#include "samara/kirchhoff/surfaces/refinement.hpp"

namespace samara {

/// The relative change of the volume by which a surface of slivers may be thinned out.
inline constexpr double lost_volume_allowed = 2e-3;

/// One body's surfaces of order 2 from coarse to fine.
///
/// Rung 0 is the given surface; or, where that has too_many_near_pairs(), the finest coarser one with few,
/// as long as that keeps the volume to lost_volume_allowed. Each below has about half of the triangles
/// of the next, some of its corners and the curvature that its own order tells: the given one for order 2,
/// and for order 1 what rebuilding makes of their own corners alone, so that rungs differ by what rebuilding
/// gets wrong too. Those above cut each triangle in four on the same curved surface.
class SurfaceLadder {
  public:
    /// Makes rung 0 of a closed surface with merged vertices; one of order 1 is rebuilt.
    explicit SurfaceLadder(const Surface& surface, int threads = 0);

    [[nodiscard]] const CreasedSurface& base() const { return rungs_.at(0); }

    /// Returns whether the curvature is rebuilt from flat triangles.
    [[nodiscard]] bool is_rebuilt() const { return is_rebuilt_; }

    /// Returns a rung, which is made when it is first asked for. Valid as long as the ladder.
    const CreasedSurface& rung(int index);

    /// Returns the lowest rung that can be asked for: the last with enough triangles to tell anything.
    [[nodiscard]] int lowest() const;

    /// Returns the relative change of the volume where rung 0 is a coarser surface than the given one; else
    /// 0.
    [[nodiscard]] double lost_volume() const { return lost_volume_; }

  private:
    void thin_out();

    int threads_;
    bool is_rebuilt_;
    double lost_volume_ = 0.0;
    std::map<int, CreasedSurface> rungs_;
};

/// Returns the thickness of a body relative to its triangles: the distance from a triangle's centroid
/// straight into the body to the other side, over the triangle's longest edge; the value that a fifth of the
/// surface's area lies below. Measured on the flat corner triangles, from up to 200 of them.
double relative_thickness(const Surface& surface);

/// Returns about how many pairs of triangles are too near, for their longest edges, for products of rules:
/// some ten for each triangle of a good shape, and all pairs of a fan of slivers. Counted on the flat corner
/// triangles, for up to 200 of them.
double near_pairs(const Surface& surface);

/// Returns whether slivers make the near pairs so many that their integrals take seconds.
bool too_many_near_pairs(const Surface& surface);

}  // namespace samara
