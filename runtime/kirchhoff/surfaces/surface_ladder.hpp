#pragma once

#include <map>

#include "samara/core/surface/surface.hpp"
#include "samara/kirchhoff/surfaces/refinement.hpp"

namespace samara {

/// One body's surfaces of order 2 from coarse to fine.
///
/// Rung 0 is the given surface; each below has about half of the triangles of the next, some of its corners
/// and the curvature that its own order tells: the given one for order 2, and for order 1 what rebuilding
/// makes of their own corners alone, so that rungs differ by what rebuilding gets wrong too. Those above cut
/// each triangle in four on the same curved surface.
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

  private:
    int threads_;
    bool is_rebuilt_;
    std::map<int, CreasedSurface> rungs_;
};

/// Returns the thickness of a body relative to its triangles: the distance from a triangle's centroid
/// straight into the body to the other side, over the triangle's longest edge; the value that a fifth of the
/// surface's area lies below. Measured on the flat corner triangles, from up to 200 of them.
double relative_thickness(const Surface& surface);

}  // namespace samara
