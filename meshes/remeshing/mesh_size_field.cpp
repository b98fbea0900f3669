#include "meshes/remeshing/mesh_size_field.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <utility>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/core/surface/creases.hpp"
#include "samara/core/surface/surface.hpp"
#include "samara/core/surface/surface_edges.hpp"

namespace samara {
namespace {

// Sizes are graded within this part of the body's reach from an edge.
constexpr double edge_reach = 0.25;
// How the size varies over a body (docs/reference/shapes.md); the values were found by trial, for flat and
// curved triangles.
constexpr double curvature_power = 0.4;    // of the radius of the strongest curvature
constexpr double smallest = 0.2;           // by curvature, relative to the largest size
constexpr double smallest_at_edges = 0.3;  // relative to the largest size
constexpr double steepest = 3.0;           // change of the relative size over the body's reach

// Returns the greatest distance of a vertex from the surface's centroid.
double reach_of(const Surface& surface) {
    Vector3d middle = Vector3d::Zero();
    double area = 0.0;
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        const double weight = area_vector(surface, t).norm();
        middle += weight * triangle_centroid(surface, t);
        area += weight;
    }
    middle /= area;
    double reach = 0.0;
    for (const Vector3d& vertex : surface.vertices) reach = std::max(reach, (vertex - middle).norm());
    return reach;
}

// Returns the angle (radians) between the normals of the two triangles at the edge.
double angle_at(const Surface& surface, std::span<const EdgeUse> edge) {
    const Vector3d first = area_vector(surface, as_index(edge.front().triangle));
    const Vector3d second = area_vector(surface, as_index(edge.back().triangle));
    return std::atan2(first.cross(second).norm(), first.dot(second));
}

std::vector<TriangleTree::Triangle> sharp_edges(const Surface& surface) {
    std::vector<TriangleTree::Triangle> sharp;
    const std::vector<EdgeUse> uses = edge_uses(surface);
    for (const auto& edge : edges_of(uses)) {
        const EdgeUse& use = edge.front();
        if (angle_at(surface, edge) > sharp_angle) sharp.push_back({use.low, use.high, use.high});
    }
    return sharp;
}

// The strongest normal curvature (1/m) at each vertex, without sharp edges: by the curvature tensor of
// Cohen-Steiner and Morvan, Restricted Delaunay Triangulations and Normal Cycle, SoCG 2003, summed over the
// triangles around the vertex and its neighbours.
class Curvature {
  public:
    explicit Curvature(const Surface& surface)
        : surface_(surface),
          tensors_(surface.vertices.size(), Matrix3d::Zero()),
          areas_(surface.vertices.size(), 0.0),
          neighbours_(surface.vertices.size()) {
        const std::vector<EdgeUse> uses = edge_uses(surface);
        for (const auto& edge : edges_of(uses)) add(edge);
        for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
            for (const std::int32_t corner : surface.corners[t]) {
                areas_[as_index(corner)] += area_vector(surface, t).norm() / 3.0;
            }
        }
    }

    [[nodiscard]] double strongest(std::size_t vertex) const {
        Matrix3d tensor = tensors_[vertex];
        double area = areas_[vertex];
        for (const auto& [other, distance] : neighbours_[vertex]) {
            tensor += tensors_[other];
            area += areas_[other];
        }
        return eigenvalues_of(tensor).cwiseAbs().maxCoeff() / area;
    }

    [[nodiscard]] double area(std::size_t vertex) const { return areas_[vertex]; }

    // Lowers values so that they differ by at most `slope` times the distance along the surface's edges:
    // Dijkstra.
    void spread(std::vector<double>& values, double slope) const {
        using Entry = std::pair<double, std::size_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        for (std::size_t i = 0; i < values.size(); ++i) queue.emplace(values[i], i);
        while (!queue.empty()) {
            const auto [value, vertex] = queue.top();
            queue.pop();
            if (value > values[vertex]) continue;
            for (const auto& [next, distance] : neighbours_[vertex]) {
                const double candidate = value + slope * distance;
                if (candidate >= values[next]) continue;
                values[next] = candidate;
                queue.emplace(candidate, next);
            }
        }
    }

  private:
    void add(std::span<const EdgeUse> edge) {
        const std::size_t low = as_index(edge.front().low);
        const std::size_t high = as_index(edge.front().high);
        const Vector3d along = surface_.vertices[high] - surface_.vertices[low];
        const double length = along.norm();
        neighbours_[low].emplace_back(high, length);
        neighbours_[high].emplace_back(low, length);
        const double angle = angle_at(surface_, edge);
        if (angle > sharp_angle) return;
        const Vector3d first = area_vector(surface_, as_index(edge.front().triangle));
        const Vector3d second = area_vector(surface_, as_index(edge.back().triangle));
        const bool hollow = first.cross(second).dot(along) * (edge.front().forward ? 1.0 : -1.0) < 0.0;
        const Matrix3d part = 0.5 * (hollow ? -angle : angle) / length * along * along.transpose();
        tensors_[low] += part;
        tensors_[high] += part;
    }

    const Surface& surface_;
    std::vector<Matrix3d> tensors_;
    std::vector<double> areas_;
    std::vector<std::vector<std::pair<std::size_t, double>>> neighbours_;
};

}  // namespace

MeshSizeField::MeshSizeField(const Surface& reference)
    : reach_(reach_of(reference)),
      tree_(reference.vertices, reference.corners),
      edges_(reference.vertices, sharp_edges(reference)) {
    const Curvature curvature(reference);
    for (std::size_t i = 0; i < reference.vertices.size(); ++i) {
        const double strongest = curvature.strongest(i);
        radii_.push_back(1.0 / strongest);
        areas_.push_back(curvature.area(i));
        const double bent = std::max(1.0, strongest * reach_);
        by_curvature_.push_back(std::max(smallest, std::pow(bent, -curvature_power)));
    }
    curvature.spread(by_curvature_, steepest / reach_);
}

double MeshSizeField::size_for_curvature() const {
    constexpr double side = 0.9;                   // relative to the radius
    constexpr double smallest_radius = 0.01;       // relative to the reach
    constexpr double left_out = 0.02;              // of the area
    std::vector<std::pair<double, double>> sizes;  // each with the area at its vertex
    double whole = 0.0;
    for (std::size_t i = 0; i < radii_.size(); ++i) {
        whole += areas_[i];
        if (radii_[i] < smallest_radius * reach_) continue;
        const double relative = std::min(by_curvature_[i], by_edges(tree_.vertices()[i]));
        sizes.emplace_back(side * radii_[i] / relative, areas_[i]);
    }
    std::sort(sizes.begin(), sizes.end());
    double below = 0.0;
    for (const auto& [size, area] : sizes) {
        below += area;
        if (below > left_out * whole) return size;
    }
    return std::numeric_limits<double>::infinity();
}

double MeshSizeField::by_edges(const Vector3d& point) const {
    const TriangleTree::Nearest nearest = edges_.nearest(point, edge_reach * reach_);
    if (!std::isfinite(nearest.squared_distance)) return 1.0;
    const double distance = std::sqrt(nearest.squared_distance) / reach_;
    return std::min(std::max(smallest_at_edges, std::sqrt(distance / edge_reach)),
                    smallest_at_edges + steepest * distance);
}

double MeshSizeField::operator()(const Vector3d& point) const {
    const TriangleTree::Nearest nearest = tree_.nearest(point);
    const std::size_t t = nearest.triangle;
    double weighted = 0.0;
    double total = 0.0;
    for (int i = 0; i < 3; ++i) {
        const Vector3d one = tree_.corner(t, (i + 1) % 3) - nearest.point;
        const Vector3d two = tree_.corner(t, (i + 2) % 3) - nearest.point;
        const double weight = one.cross(two).norm();
        weighted += weight * by_curvature_[as_index(tree_.triangles()[t][static_cast<std::size_t>(i)])];
        total += weight;
    }
    const double by_curvature =
        total > 0.0 ? weighted / total : by_curvature_[as_index(tree_.triangles()[t][0])];
    return std::min(by_curvature, by_edges(nearest.point));
}

double MeshSizeField::triangle_count(double size) const {
    constexpr double samples_of_the_area = 4000.0;
    std::vector<double> areas;
    double whole = 0.0;
    for (std::size_t t = 0; t < tree_.triangles().size(); ++t) {
        const Vector3d& a = tree_.corner(t, 0);
        areas.push_back(0.5 * (tree_.corner(t, 1) - a).cross(tree_.corner(t, 2) - a).norm());
        whole += areas.back();
    }
    double count = 0.0;
    for (std::size_t t = 0; t < areas.size(); ++t) {
        visit_middles(tree_.corner(t, 0), tree_.corner(t, 1), tree_.corner(t, 2),
                      areas[t] / whole * samples_of_the_area, [&](const Vector3d& place, int parts) {
                          const double side = size * (*this)(place);
                          count += areas[t] / parts / (std::sqrt(3.0) / 4.0 * side * side);
                      });
    }
    return count;
}

}  // namespace samara
