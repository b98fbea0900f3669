#pragma once

#include <vector>

#include "meshes/triangle_tree.hpp"
#include "samara/body/surface.hpp"

namespace samara {

/// Faces that meet at more than this angle (radians, 40 degrees) meet in an edge of the body; at less, they
/// stand for a curved surface.
inline constexpr double sharp_angle = 0.6981317007977318;

/// Where a body's surface needs smaller triangles: the wanted length of sides at each place, over that where
/// the body is flat and far from its edges. It falls with the radius of curvature to the power 0.4, down to
/// 0.2, and within a quarter of the body's reach (its greatest distance from the middle) towards edges with
/// the square root of the distance, as the flow's potential varies there, down to 0.3; it changes by at most
/// 3 over the reach. Measured on a reference surface, which should resolve the curvature.
class MeshSizeField {
  public:
    /// The reference must be closed, its vertices welded.
    explicit MeshSizeField(const Surface& reference);

    /// The relative size at the point of the reference that is nearest to `point`.
    [[nodiscard]] double operator()(const Vector3d& point) const;

    /// The number of equilateral triangles of the wanted size that cover the surface, where 1 stands for
    /// sides of the length `size` (m).
    [[nodiscard]] double triangle_count(double size) const;

  private:
    TriangleTree tree_;
    std::vector<double> relative_size_;  // at each vertex
};

}  // namespace samara
