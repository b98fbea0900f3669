#include "samara/kirchhoff/surface_projection.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "samara/base/parallel_for.hpp"
#include "samara/body/curved_surface.hpp"
#include "samara/body/surface_edges.hpp"

namespace samara {
namespace {

std::size_t as_index(std::int32_t value) {
    return static_cast<std::size_t>(value);
}

/// The corners of a surface, which way they look, and the triangles around each.
class Vertices {
  public:
    explicit Vertices(const Surface& surface)
        : surface_(surface), normals_(surface.vertices.size(), Vector3d::Zero()), around_(normals_.size()) {
        for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
            for (const std::int32_t corner : surface.corners[t]) {
                normals_[as_index(corner)] += area_vector(surface, t);
                around_[as_index(corner)].push_back(t);
            }
        }
    }

    [[nodiscard]] const Vector3d& normal(std::size_t vertex) const { return normals_[vertex]; }

    /// A point of the curved triangles near `point`, where they look along `direction`; `point` itself where
    /// none do.
    [[nodiscard]] Vector3d near_point(const Vector3d& point, const Vector3d& direction) const {
        const std::size_t vertex = nearest_corner(point, direction);
        Vector3d best = point;
        double least = std::numeric_limits<double>::infinity();
        if (vertex == normals_.size()) return best;
        for (const std::size_t t : around_[vertex]) {
            const Vector3d found = on_triangle(t, point);
            const double distance = (found - point).squaredNorm();
            if (distance >= least) continue;
            least = distance;
            best = found;
        }
        return best;
    }

  private:
    [[nodiscard]] std::size_t nearest_corner(const Vector3d& point, const Vector3d& direction) const {
        std::size_t nearest = normals_.size();
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t v = 0; v < normals_.size(); ++v) {
            const double distance = (surface_.vertices[v] - point).squaredNorm();
            if (distance >= least || !(normals_[v].dot(direction) > 0.0)) continue;
            least = distance;
            nearest = v;
        }
        return nearest;
    }

    /// The point of the curved triangle over the point of the flat one that is nearest.
    [[nodiscard]] Vector3d on_triangle(std::size_t t, const Vector3d& point) const {
        const auto& [a, b, c] = surface_.corners[t];
        const Vector3d& origin = surface_.vertices[as_index(a)];
        const Vector3d one = surface_.vertices[as_index(b)] - origin;
        const Vector3d other = surface_.vertices[as_index(c)] - origin;
        const Vector3d arm = point - origin;
        const Eigen::Matrix2d gram{{one.dot(one), one.dot(other)}, {one.dot(other), other.dot(other)}};
        const Eigen::Vector2d place = gram.inverse() * Eigen::Vector2d(one.dot(arm), other.dot(arm));
        // Outside the triangle, as far as its edge: a neighbour has the nearer point.
        const double u = std::clamp(place.x(), 0.0, 1.0);
        const double v = std::clamp(place.y(), 0.0, 1.0 - u);
        return point_of_triangle(surface_, t, u, v);
    }

    const Surface& surface_;
    std::vector<Vector3d> normals_;
    std::vector<std::vector<std::size_t>> around_;
};

}  // namespace

Surface drawn_onto(const Surface& coarse, const Surface& fine, int threads) {
    const Vertices fine_vertices(fine);
    const Vertices coarse_vertices(coarse);
    Surface result = with_straight_edge_nodes(coarse);
    const std::vector<EdgeUse> uses = edge_uses(coarse);
    const auto edges = edges_of(uses);
    parallel_for(edges.size(), 64, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const EdgeUse& use = edges[i].front();
            const Vector3d direction =
                coarse_vertices.normal(as_index(use.low)) + coarse_vertices.normal(as_index(use.high));
            Vector3d& node =
                result.vertices[as_index(result.edge_nodes[as_index(use.triangle)][as_index(use.side)])];
            node = fine_vertices.near_point(node, direction);
        }
    });
    return without_folds(std::move(result));
}

Surface without_folds(Surface surface) {
    // A neighbour may fold where it did not before.
    for (std::vector<std::int32_t> folded = overturned_triangles(surface); !folded.empty();) {
        for (const std::int32_t t : folded) {
            const auto& corners = surface.corners[as_index(t)];
            for (std::size_t side = 0; side < 3; ++side) {
                const auto node = as_index(surface.edge_nodes[as_index(t)][side]);
                surface.vertices[node] = 0.5 * (surface.vertices[as_index(corners[side])] +
                                                surface.vertices[as_index(corners[(side + 1) % 3])]);
            }
        }
        const std::vector<std::int32_t> still = overturned_triangles(surface);
        if (still == folded) break;
        folded = still;
    }
    return surface;
}

}  // namespace samara
