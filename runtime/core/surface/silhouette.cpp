#include "samara/core/surface/silhouette.hpp"

#include <algorithm>
#include <cmath>

#include "samara/core/base/numbers.hpp"
#include "samara/core/surface/surface_edges.hpp"

namespace samara {
namespace {

constexpr double smooth_angle = 25.0 * degree;
constexpr double edge_angle = 55.0 * degree;

/// An edge between two faces.
struct Edge {
    Vector3d vector;  ///< from one end to the other
    Vector3d normals[2];
    double sharpness;  ///< 0 to 1
};

std::vector<Edge> edges_between(const Surface& surface, const std::vector<Vector3d>& normals) {
    std::vector<Edge> edges;
    const std::vector<EdgeUse> uses = edge_uses(surface);
    for (const auto& run : edges_of(uses)) {
        if (run.size() != 2) continue;
        const Vector3d& one = normals[static_cast<std::size_t>(run[0].triangle)];
        const Vector3d& other = normals[static_cast<std::size_t>(run[1].triangle)];
        const double angle = std::acos(std::clamp(one.dot(other), -1.0, 1.0));
        edges.push_back({vertex(surface, run[0].high) - vertex(surface, run[0].low),
                         {one, other},
                         std::clamp((angle - smooth_angle) / (edge_angle - smooth_angle), 0.0, 1.0)});
    }
    return edges;
}

double edge_share_of(const std::vector<Edge>& edges, const Vector3d& direction) {
    double all = 0.0;
    double sharp = 0.0;
    for (const Edge& edge : edges) {
        if ((edge.normals[0].dot(direction) >= along_the_flow) ==
            (edge.normals[1].dot(direction) >= along_the_flow))
            continue;
        const double length = (edge.vector - edge.vector.dot(direction) * direction).norm();
        all += length;
        sharp += edge.sharpness * length;
    }
    return all > 0.0 ? sharp / all : 0.0;
}

}  // namespace

std::vector<Silhouette> silhouettes(const Surface& surface, const std::vector<Vector3d>& directions) {
    std::vector<Vector3d> normals;
    std::vector<Vector3d> areas;
    double volume = 0.0;
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        areas.push_back(area_vector(surface, t));
        normals.push_back(areas.back().stableNormalized());
        volume += areas.back().dot(triangle_centroid(surface, t)) / 3.0;
    }
    const std::vector<Edge> edges = edges_between(surface, normals);
    std::vector<Silhouette> result;
    for (const Vector3d& direction : directions) {
        double projected = 0.0;
        for (const Vector3d& area : areas) projected += std::max(0.0, area.dot(direction));
        result.push_back({edge_share_of(edges, direction), volume / std::pow(projected, 1.5)});
    }
    return result;
}

}  // namespace samara
