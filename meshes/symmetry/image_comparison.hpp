#pragma once

#include <limits>
#include <vector>

#include "meshes/checks/triangle_tree.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// How far the flat triangles of a surface of order 1 may lie within the curved surface that they stand for,
/// over the greatest distance of a vertex from `centre`; at most 0.05. Zero for curved triangles.
double faceting(const Surface& surface, const Vector3d& centre);

/// Compares a surface with its images under rotations and reflections about a point: the shapes, not the
/// triangulations. The points of the image that are compared are the vertices and points spread over
/// the triangles, at most 5000.
class ImageComparison {
  public:
    /// `tolerance`: over the body's size, its greatest distance from the centre; raised to the faceting, and
    /// at most 0.05.
    ImageComparison(const Surface& surface, const Vector3d& centre, double tolerance);

    /// Whether each of the first points of the image lies within `slack` times the tolerance of the surface.
    [[nodiscard]] bool is_symmetry(const Matrix3d& element, double slack = 1.0,
                                   std::size_t points = std::numeric_limits<std::size_t>::max()) const;

    /// The mean distance of the first points of the image from the surface, over the body's size; some number
    /// above `enough`, and sooner, where it is above that.
    [[nodiscard]] double mean_distance(const Matrix3d& element, std::size_t points,
                                       double enough = std::numeric_limits<double>::infinity()) const;

    /// The distance over the body's size within which an image counts as the same.
    [[nodiscard]] double tolerance() const { return tolerance_; }

    /// Points of the surface, relative to the centre (m), in no special order.
    [[nodiscard]] const std::vector<Vector3d>& points() const { return points_; }

  private:
    double size_;
    double tolerance_;
    std::vector<Vector3d> points_;
    TriangleTree tree_;
};

}  // namespace samara
