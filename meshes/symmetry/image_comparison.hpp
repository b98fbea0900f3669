#pragma once

#include <limits>
#include <vector>

#include "meshes/checks/triangle_tree.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// Estimates how far the flat triangles of a surface of order 1 lie within the curved surface that they
/// approximate, relative to the greatest distance of a vertex from `centre`; at most 0.05, zero for curved
/// triangles.
double faceting(const Surface& surface, const Vector3d& centre);

/// Compares a surface with its images under rotations and reflections about a point, regardless of the
/// triangulation. The compared points are the vertices and points spread over the triangles, at most 5000.
class ImageComparison {
  public:
    /// `tolerance`: relative to the body's size, its greatest distance from the centre; raised to the
    /// faceting, and at most 0.05.
    ImageComparison(const Surface& surface, const Vector3d& centre, double tolerance);

    /// Whether each of the first `points` points of the image lies within `slack` times the tolerance of the
    /// surface.
    [[nodiscard]] bool is_symmetry(const Matrix3d& element, double slack = 1.0,
                                   std::size_t points = std::numeric_limits<std::size_t>::max()) const;

    /// Returns the mean distance of the first `points` points of the image from the surface, relative to the
    /// body's size. Where it exceeds `enough`, the search stops early with some value above that.
    [[nodiscard]] double mean_distance(const Matrix3d& element, std::size_t points,
                                       double enough = std::numeric_limits<double>::infinity()) const;

    /// The distance, relative to the body's size, within which an image counts as equal.
    [[nodiscard]] double tolerance() const { return tolerance_; }

    /// The points of the surface, relative to the centre (m), in random order.
    [[nodiscard]] const std::vector<Vector3d>& points() const { return points_; }

  private:
    double size_;
    double tolerance_;
    std::vector<Vector3d> points_;
    TriangleTree tree_;
};

}  // namespace samara
