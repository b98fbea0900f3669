#pragma once

#include <vector>

#include "samara/body/surface.hpp"

namespace samara {

/// The points of a curved surface that are near given ones.
class SurfaceProjection {
  public:
    /// `surface`: of order 2, and outlives this.
    explicit SurfaceProjection(const Surface& surface);

    /// A point of the curved triangles near `point`, where they look along `direction`; `point` itself where
    /// none do.
    [[nodiscard]] Vector3d near_point(const Vector3d& point, const Vector3d& direction) const;

  private:
    [[nodiscard]] Vector3d on_triangle(std::size_t triangle, const Vector3d& point) const;

    const Surface& surface_;
    std::vector<std::size_t> corners_;  // the vertices that are corners
    std::vector<Vector3d> normals_;     // of each of these
    std::vector<std::vector<std::size_t>> around_;
};

/// The sum of the area vectors of the flat triangles around each vertex.
std::vector<Vector3d> vertex_normals(const Surface& surface);

/// The coarse flat triangles as curved ones of order 2 whose edge nodes lie on the fine surface, near the
/// middles of the edges, on the side that looks the same way. `coarse`: of order 1. Triangles that would fold
/// keep straight edges.
Surface drawn_onto(const Surface& coarse, const SurfaceProjection& fine, int threads = 0);

}  // namespace samara
