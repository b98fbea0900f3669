#pragma once

#include <vector>

#include "meshes/checks/triangle_tree.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// The wanted length of triangle sides at each place of a body's surface, relative to that where the body is
/// flat and far from its edges. It decreases with the strongest curvature, and within a quarter of the body's
/// reach (its greatest distance from the middle) of sharp edges with the square root of the distance, as the
/// flow's potential varies there. It is measured on a reference surface, which should resolve the curvature.
class MeshSizeField {
  public:
    /// The reference must be closed, its vertices welded.
    explicit MeshSizeField(const Surface& reference);

    /// Returns the relative size at the point of the reference that is nearest to `point`.
    [[nodiscard]] double operator()(const Vector3d& point) const;

    /// Returns the number of equilateral triangles of the wanted size that cover the surface, where the
    /// relative size 1 means sides of length `size` (m).
    [[nodiscard]] double triangle_count(double size) const;

    /// Returns the size (m) with which sides are no longer than 0.9 times the least radius of curvature on
    /// all but 2 % of the surface, so that quadratic triangles follow it. Radii below a hundredth of the
    /// reach are ignored.
    [[nodiscard]] double size_for_curvature() const;

  private:
    [[nodiscard]] double by_edges(const Vector3d& point) const;

    double reach_;
    TriangleTree tree_;
    TriangleTree edges_;         // triangles without width
    std::vector<double> radii_;  // the least radius of curvature (m) at each vertex, and the area there
    std::vector<double> areas_;
    std::vector<double> by_curvature_;  // at each vertex
};

}  // namespace samara
