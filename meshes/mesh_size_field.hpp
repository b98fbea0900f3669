#pragma once

#include <vector>

#include "meshes/triangle_tree.hpp"
#include "samara/body/surface.hpp"
#include "samara/kirchhoff/creases.hpp"

namespace samara {

/// How the size of triangles varies over a body.
struct SizeLaw {
    double curvature_power = 0.4;    ///< of the radius of the strongest curvature
    double smallest = 0.2;           ///< by curvature, over the largest
    double smallest_at_edges = 0.3;  ///< over the largest
    double steepest = 3.0;           ///< change of the relative size over the body's reach
};

/// The laws that were found best for flat and for curved triangles.
SizeLaw size_law(int order);

/// Where a body's surface needs smaller triangles: the wanted length of sides at each place, over that where
/// the body is flat and far from its edges. It falls with the strongest curvature, and within a quarter of
/// the body's reach (its greatest distance from the middle) towards sharp edges with the square root of the
/// distance, as the flow's potential varies there. Measured on a reference surface, which should resolve the
/// curvature.
class MeshSizeField {
  public:
    /// The reference must be closed, its vertices welded.
    MeshSizeField(const Surface& reference, const SizeLaw& law);

    /// The relative size at the point of the reference that is nearest to `point`.
    [[nodiscard]] double operator()(const Vector3d& point) const;

    /// The number of equilateral triangles of the wanted size that cover the surface, where 1 stands for
    /// sides of the length `size` (m).
    [[nodiscard]] double triangle_count(double size) const;

  private:
    [[nodiscard]] double by_edges(const Vector3d& point) const;

    SizeLaw law_;
    double reach_;
    TriangleTree tree_;
    TriangleTree edges_;                // triangles without width
    std::vector<double> by_curvature_;  // at each vertex
};

}  // namespace samara
