#include "samara/kirchhoff/surfaces/surface_ladder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include "samara/core/base/numbers.hpp"
#include "samara/core/base/parallel_for.hpp"
#include "samara/core/surface/curved_surface.hpp"
#include "samara/core/surface/surface.hpp"
#include "samara/core/surface/surface_edges.hpp"
#include "samara/kirchhoff/surfaces/rebuilt_surface.hpp"
#include "samara/kirchhoff/surfaces/refinement.hpp"

namespace samara {
namespace {

/// The points of a curved surface that are near given ones.
class SurfaceProjection {
  public:
    /// Prepares a surface of order 2, which must outlive this.
    explicit SurfaceProjection(const Surface& surface);

    /// Returns a point of the curved triangles near `point`, where their normals point along `direction`;
    /// `point` itself where none do.
    [[nodiscard]] Vector3d near_point(const Vector3d& point, const Vector3d& direction) const;

  private:
    [[nodiscard]] Vector3d on_triangle(std::size_t triangle, const Vector3d& point) const;

    const Surface& surface_;
    std::vector<std::size_t> corners_;  // the vertices that are corners
    std::vector<Vector3d> normals_;     // of each of these
    std::vector<std::vector<std::size_t>> around_;
};

/// Returns the sum of the area vectors of the flat triangles around each vertex.
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

/// Returns the point of the curved triangle over the point of the flat one that is nearest; outside it, as
/// far as its edge, since a neighbour has the nearer point.
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

/// Returns the coarse flat triangles as curved ones of order 2 whose edge nodes lie on the fine surface, near
/// the middles of the edges, on the side whose normals agree. `coarse`: of order 1; `fine`: of order 2.
/// Triangles that would fold keep straight edges. The result does not depend on `threads` (0: all cores).
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

constexpr std::size_t fewest_triangles = 60;
constexpr double quick_near_pairs = 1.5e5;  // a quarter of a second

constexpr std::size_t most_samples = 200;
constexpr double share_of_area = 0.2;

/// Returns the distance from the origin along the unit vector to the triangle; infinity where it is missed.
/// Moeller and Trumbore, J. Graphics Tools 2(1), 1997.
double distance_along(const Vector3d& direction, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    constexpr double missed = std::numeric_limits<double>::infinity();
    const Vector3d one = b - a;
    const Vector3d other = c - a;
    const Vector3d across = direction.cross(other);
    const double determinant = one.dot(across);
    if (determinant == 0.0) return missed;
    const double u = -a.dot(across) / determinant;
    if (u < 0.0 || u > 1.0) return missed;
    const Vector3d along = (-a).cross(one);
    const double v = direction.dot(along) / determinant;
    if (v < 0.0 || u + v > 1.0) return missed;
    const double distance = other.dot(along) / determinant;
    return distance > 0.0 ? distance : missed;
}

double thickness_under(const Surface& surface, std::size_t triangle) {
    const Vector3d start = triangle_centroid(surface, triangle);
    const Vector3d inwards = -area_vector(surface, triangle).normalized();
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        if (t == triangle) continue;
        const auto corner = [&](std::size_t i) -> Vector3d {
            return surface.vertices[static_cast<std::size_t>(surface.corners[t][i])] - start;
        };
        nearest = std::min(nearest, distance_along(inwards, corner(0), corner(1), corner(2)));
    }
    return nearest;
}

}  // namespace

SurfaceLadder::SurfaceLadder(const Surface& surface, int threads)
    : threads_(threads), is_rebuilt_(surface.order() == 1) {
    Creases creases = find_creases(surface);
    Surface curved = surface.order() == 2 ? surface : rebuilt_surface(surface, creases, threads);
    rungs_.emplace(0, CreasedSurface{std::move(curved), std::move(creases)});
    if (too_many_near_pairs(surface)) thin_out();
}

int SurfaceLadder::lowest() const {
    int index = 0;
    for (std::size_t count = base().surface.triangle_count(); count / 2 >= fewest_triangles; count /= 2)
        --index;
    return index;
}

const CreasedSurface& SurfaceLadder::rung(int index) {
    if (const auto known = rungs_.find(index); known != rungs_.end()) return known->second;
    if (index > 0) return rungs_.emplace(index, refined(rung(index - 1))).first->second;
    const CreasedSurface& finer = rung(index + 1);
    CreasedSurface coarse = coarsened(finer, finer.surface.triangle_count() / 2);
    coarse.surface = is_rebuilt_ ? rebuilt_surface(coarse.surface, coarse.creases, threads_)
                                 : drawn_onto(coarse.surface, base().surface, threads_);
    return rungs_.emplace(index, std::move(coarse)).first->second;
}

void SurfaceLadder::thin_out() {
    const double volume = enclosed_volume(without_edge_nodes(base().surface));
    for (int index = -1; index >= lowest(); --index) {
        const Surface& coarser = rung(index).surface;
        if (coarser.triangle_count() >= rung(index + 1).surface.triangle_count()) return;
        const double lost = std::abs(enclosed_volume(coarser) / volume - 1.0);
        if (!(lost < lost_volume_allowed)) return;
        if (near_pairs(coarser) > quick_near_pairs) continue;
        CreasedSurface chosen = rungs_.at(index);
        rungs_.clear();
        rungs_.emplace(0, std::move(chosen));
        lost_volume_ = lost;
        return;
    }
}

double near_pairs(const Surface& surface) {
    constexpr double reach = 1.2;  // in sums of both radii
    const std::size_t count = surface.triangle_count();
    std::vector<Vector3d> centroids(count);
    std::vector<double> radii(count, 0.0);
    for (std::size_t t = 0; t < count; ++t) {
        centroids[t] = triangle_centroid(surface, t);
        for (const std::int32_t corner : surface.corners[t]) {
            radii[t] = std::max(radii[t], (surface.vertices[as_index(corner)] - centroids[t]).norm());
        }
    }
    const std::size_t stride = count / most_samples + 1;
    std::size_t samples = 0;
    std::size_t near = 0;
    for (std::size_t t = 0; t < count; t += stride) {
        ++samples;
        for (std::size_t other = 0; other < count; ++other) {
            const double distance = reach * (radii[t] + radii[other]);
            if ((centroids[other] - centroids[t]).squaredNorm() < distance * distance) ++near;
        }
    }
    return 0.5 * static_cast<double>(near) * static_cast<double>(count) / static_cast<double>(samples);
}

bool too_many_near_pairs(const Surface& surface) {
    constexpr double of_slivers = 250.0;  // for each triangle
    const double pairs = near_pairs(surface);
    return pairs > quick_near_pairs && pairs > of_slivers * static_cast<double>(surface.triangle_count());
}

double relative_thickness(const Surface& surface) {
    const std::size_t stride = surface.triangle_count() / most_samples + 1;
    std::vector<std::pair<double, double>> samples;  // thickness, area
    double area = 0.0;
    for (std::size_t t = 0; t < surface.triangle_count(); t += stride) {
        const double own = area_vector(surface, t).norm();
        samples.emplace_back(thickness_under(surface, t) / longest_edge(surface, t), own);
        area += own;
    }
    std::sort(samples.begin(), samples.end());
    double below = 0.0;
    for (const auto& [thickness, own] : samples) {
        below += own;
        if (below >= share_of_area * area) return thickness;
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace samara
