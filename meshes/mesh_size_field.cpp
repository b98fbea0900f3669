#include "meshes/mesh_size_field.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>

#include "samara/body/surface.hpp"
#include "samara/body/surface_edges.hpp"

namespace samara {
namespace {

constexpr double smallest = 0.2;
constexpr double smallest_at_edges = 0.3;
// Between 1/4, which is best for the volume of flat triangles on an ellipsoid, and 1/2, which is best for a
// thick part on a large thin one.
constexpr double curvature_power = 0.4;
// Edges grade out to this part of the body's reach.
constexpr double edge_reach = 0.25;
constexpr double steepest_over_reach = 3.0;

struct Neighbour {
    std::size_t vertex;
    double distance;
};

std::size_t as_index(std::int32_t value) {
    return static_cast<std::size_t>(value);
}

// The greatest distance of a vertex from the middle of all.
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

class Sizing {
  public:
    explicit Sizing(const Surface& surface)
        : surface_(surface),
          reach_(reach_of(surface)),
          curvature_(surface.vertices.size(), 0.0),
          edge_distance_(surface.vertices.size(), std::numeric_limits<double>::infinity()),
          neighbours_(surface.vertices.size()) {
        const std::vector<EdgeUse> uses = edge_uses(surface);
        for (const auto& edge : edges_of(uses)) {
            if (edge.size() == 2) measure(edge[0], edge[1]);
        }
    }

    std::vector<double> relative_sizes() {
        spread(edge_distance_, 1.0);
        std::vector<double> sizes(surface_.vertices.size());
        for (std::size_t i = 0; i < sizes.size(); ++i) {
            const double by_curvature =
                std::max(smallest, std::pow(std::max(1.0, curvature_[i] * reach_), -curvature_power));
            const double by_edges = std::max(
                smallest_at_edges, std::sqrt(std::min(1.0, edge_distance_[i] / (edge_reach * reach_))));
            sizes[i] = std::min(by_curvature, by_edges);
        }
        spread(sizes, steepest_over_reach / reach_);
        return sizes;
    }

  private:
    void measure(const EdgeUse& one, const EdgeUse& two) {
        const Vector3d first = area_vector(surface_, as_index(one.triangle));
        const Vector3d second = area_vector(surface_, as_index(two.triangle));
        const double angle = std::atan2(first.cross(second).norm(), first.dot(second));
        const double length =
            (surface_.vertices[as_index(one.high)] - surface_.vertices[as_index(one.low)]).norm();
        // Heights of the two triangles over the edge: their centroids lie a third of that from it.
        const double between_centroids = 2.0 * (first.norm() + second.norm()) / length / 3.0;
        for (const auto& [from, to] : {std::pair{one.low, one.high}, std::pair{one.high, one.low}}) {
            neighbours_[as_index(from)].push_back({as_index(to), length});
            if (angle > sharp_angle) {
                edge_distance_[as_index(from)] = 0.0;
            } else {
                double& curvature = curvature_[as_index(from)];
                curvature = std::max(curvature, angle / between_centroids);
            }
        }
    }

    // Lowers values so that they differ by at most `slope` times the distance along the surface's edges:
    // Dijkstra.
    void spread(std::vector<double>& values, double slope) const {
        using Entry = std::pair<double, std::size_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (std::isfinite(values[i])) queue.emplace(values[i], i);
        }
        while (!queue.empty()) {
            const auto [value, vertex] = queue.top();
            queue.pop();
            if (value > values[vertex]) continue;
            for (const Neighbour& next : neighbours_[vertex]) {
                const double candidate = value + slope * next.distance;
                if (candidate >= values[next.vertex]) continue;
                values[next.vertex] = candidate;
                queue.emplace(candidate, next.vertex);
            }
        }
    }

    const Surface& surface_;
    double reach_;
    std::vector<double> curvature_;
    std::vector<double> edge_distance_;
    std::vector<std::vector<Neighbour>> neighbours_;
};

}  // namespace

MeshSizeField::MeshSizeField(const Surface& reference)
    : tree_(reference.vertices, reference.corners), relative_size_(Sizing(reference).relative_sizes()) {}

double MeshSizeField::operator()(const Vector3d& point) const {
    const TriangleTree::Nearest nearest = tree_.nearest(point);
    const std::size_t t = nearest.triangle;
    double weighted = 0.0;
    double total = 0.0;
    for (int i = 0; i < 3; ++i) {
        const Vector3d one = tree_.corner(t, (i + 1) % 3) - nearest.point;
        const Vector3d two = tree_.corner(t, (i + 2) % 3) - nearest.point;
        const double weight = one.cross(two).norm();
        weighted += weight * relative_size_[as_index(tree_.triangles()[t][static_cast<std::size_t>(i)])];
        total += weight;
    }
    return total > 0.0 ? weighted / total : relative_size_[as_index(tree_.triangles()[t][0])];
}

double MeshSizeField::triangle_count(double size) const {
    double count = 0.0;
    for (std::size_t t = 0; t < tree_.triangles().size(); ++t) {
        const Vector3d& a = tree_.corner(t, 0);
        const double area = 0.5 * (tree_.corner(t, 1) - a).cross(tree_.corner(t, 2) - a).norm();
        double relative = 0.0;
        for (const std::int32_t vertex : tree_.triangles()[t])
            relative += relative_size_[as_index(vertex)] / 3.0;
        const double side = size * relative;
        count += area / (std::sqrt(3.0) / 4.0 * side * side);
    }
    return count;
}

}  // namespace samara
