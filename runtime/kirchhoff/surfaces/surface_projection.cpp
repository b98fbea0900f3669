#include "samara/kirchhoff/surfaces/surface_projection.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <Eigen/LU>

#include "samara/core/base/numbers.hpp"
#include "samara/core/base/parallel_for.hpp"
#include "samara/core/surface/curved_surface.hpp"
#include "samara/core/surface/surface_edges.hpp"

namespace samara {
namespace {

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
std::vector<Vector3d> vertex_normals(const Surface& surface) {
    std::vector<Vector3d> normals(surface.vertices.size(), Vector3d::Zero());
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        for (const std::int32_t corner : surface.corners[t]) {
            normals[as_index(corner)] += area_vector(surface, t);
        }
    }
    return normals;
}

SurfaceProjection::SurfaceProjection(const Surface& surface) : surface_(surface) {
    std::vector<std::size_t> place(surface.vertices.size(), surface.vertices.size());
    const std::vector<Vector3d> normals = vertex_normals(surface);
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        for (const std::int32_t corner : surface.corners[t]) {
            const std::size_t vertex = as_index(corner);
            if (place[vertex] == surface.vertices.size()) {
                place[vertex] = corners_.size();
                corners_.push_back(vertex);
                normals_.push_back(normals[vertex]);
                around_.emplace_back();
            }
            around_[place[vertex]].push_back(t);
        }
    }
}

Vector3d SurfaceProjection::near_point(const Vector3d& point, const Vector3d& direction) const {
    std::size_t nearest = corners_.size();
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const double distance = (surface_.vertices[corners_[i]] - point).squaredNorm();
        if (distance >= least || !(normals_[i].dot(direction) > 0.0)) continue;
        least = distance;
        nearest = i;
    }
    Vector3d best = point;
    if (nearest == corners_.size()) return best;
    least = std::numeric_limits<double>::infinity();
    for (const std::size_t t : around_[nearest]) {
        const Vector3d found = on_triangle(t, point);
        const double distance = (found - point).squaredNorm();
        if (distance >= least) continue;
        least = distance;
        best = found;
    }
    return best;
}

/// The point of the curved triangle over the point of the flat one that is nearest; outside it, as far as its
/// edge, since a neighbour has the nearer point.
Vector3d SurfaceProjection::on_triangle(std::size_t triangle, const Vector3d& point) const {
    const auto& [a, b, c] = surface_.corners[triangle];
    const Vector3d& origin = surface_.vertices[as_index(a)];
    const Vector3d one = surface_.vertices[as_index(b)] - origin;
    const Vector3d other = surface_.vertices[as_index(c)] - origin;
    const Vector3d arm = point - origin;
    const Eigen::Matrix2d gram{{one.dot(one), one.dot(other)}, {one.dot(other), other.dot(other)}};
    const Eigen::Vector2d place = gram.inverse() * Eigen::Vector2d(one.dot(arm), other.dot(arm));
    const double u = std::clamp(place.x(), 0.0, 1.0);
    const double v = std::clamp(place.y(), 0.0, 1.0 - u);
    return point_of_triangle(surface_, triangle, u, v);
}

}  // namespace

Surface drawn_onto(const Surface& coarse, const Surface& fine, int threads) {
    const SurfaceProjection shape(fine);
    const std::vector<Vector3d> normals = vertex_normals(coarse);
    Surface result = with_straight_edge_nodes(coarse);
    const std::vector<EdgeUse> uses = edge_uses(coarse);
    const auto edges = edges_of(uses);
    parallel_for(edges.size(), 64, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const EdgeUse& use = edges[i].front();
            const Vector3d direction = normals[as_index(use.low)] + normals[as_index(use.high)];
            Vector3d& node =
                result.vertices[as_index(result.edge_nodes[as_index(use.triangle)][as_index(use.side)])];
            node = shape.near_point(node, direction);
        }
    });
    straighten_overturned(result);
    return result;
}

}  // namespace samara
