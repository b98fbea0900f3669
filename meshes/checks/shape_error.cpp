#include "meshes/checks/shape_error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "meshes/checks/triangle_tree.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/core/surface/creases.hpp"
#include "samara/core/surface/curved_surface.hpp"
#include "samara/core/surface/surface_edges.hpp"
#include "samara/core/surface/welded_surface.hpp"

namespace samara {
namespace {

constexpr double most_volume = 0.005;
constexpr double most_distance = 0.005;
constexpr double most_area = 0.02;

// Cut so often, the flat pieces lie within a thousandth of a curved triangle's size of it.
constexpr int cuts_of_curved_triangle = 4;
constexpr double points_over_the_area = 4000.0;
constexpr std::size_t most_triangles = 20000;  // of more, every nth is sampled
constexpr std::size_t most_vertices = 20000;

struct Distances {
    double greatest = 0.0;  // m
    double mean = 0.0;      // over the area
};

// Measures the distances of points spread over the flat triangles, and of their vertices, from the other
// surface.
Distances distances(const Surface& from, const TriangleTree& to) {
    Distances found;
    double squared = 0.0;
    double weighted = 0.0;
    double weights = 0.0;
    const double whole = surface_area(from);
    const std::size_t stride = 1 + from.triangle_count() / most_triangles;
    for (std::size_t t = 0; t < from.triangle_count(); t += stride) {
        const double area = area_vector(from, t).norm();
        const auto corner = [&](std::size_t i) -> const Vector3d& {
            return from.vertices[static_cast<std::size_t>(from.corners[t][i])];
        };
        visit_middles(corner(0), corner(1), corner(2), area / whole * points_over_the_area,
                      [&](const Vector3d& point, int parts) {
                          const double distance = to.nearest(point).squared_distance;
                          squared = std::max(squared, distance);
                          weighted += area / parts * std::sqrt(distance);
                          weights += area / parts;
                      });
    }
    const std::size_t step = 1 + from.vertices.size() / most_vertices;
    for (std::size_t i = 0; i < from.vertices.size(); i += step) {
        squared = std::max(squared, to.nearest(from.vertices[i]).squared_distance);
    }
    found.greatest = std::sqrt(squared);
    found.mean = weights > 0.0 ? weighted / weights : 0.0;
    return found;
}

}  // namespace

ShapeError shape_error(const Surface& shape, const Surface& mesh) {
    const Surface flat_shape = flattened(shape, cuts_of_curved_triangle);
    const Surface flat_mesh = flattened(mesh, cuts_of_curved_triangle);
    const Distances outward = distances(flat_mesh, TriangleTree(flat_shape.vertices, flat_shape.corners));
    const Distances inward = distances(flat_shape, TriangleTree(flat_mesh.vertices, flat_mesh.corners));
    const VolumeMoments before = volume_moments(shape);
    const VolumeMoments after = volume_moments(mesh);
    ShapeError error;
    error.distance = std::max(outward.greatest, inward.greatest) / bounding_box(flat_shape).diagonal().norm();
    error.mean_distance = std::max(outward.mean, inward.mean);
    error.volume = after.volume / before.volume - 1.0;
    error.area = after.surface_area / before.surface_area - 1.0;
    return error;
}

Smoothing smoothing_of(const Surface& flat) {
    constexpr double coplanar = 1e-3;  // radians
    const std::vector<EdgeUse> uses = edge_uses(flat);
    const auto edges = edges_of(uses);
    const auto area = [&](const EdgeUse& use) { return area_vector(flat, as_index(use.triangle)); };
    const auto angle_at = [&](std::span<const EdgeUse> edge) {
        const Vector3d one = area(edge.front());
        const Vector3d two = area(edge.back());
        return std::atan2(one.cross(two).norm(), one.dot(two));
    };
    // Triangles in one plane are one facet.
    std::vector<std::size_t> parent(flat.triangle_count());
    std::iota(parent.begin(), parent.end(), std::size_t{0});
    const auto facet_of = [&](const EdgeUse& use) {
        std::size_t t = as_index(use.triangle);
        while (parent[t] != t) t = parent[t] = parent[parent[t]];
        return t;
    };
    for (const auto& edge : edges) {
        if (angle_at(edge) < coplanar) parent[facet_of(edge.front())] = facet_of(edge.back());
    }
    std::vector<double> facet_areas(flat.triangle_count(), 0.0);
    for (const EdgeUse& use : uses) facet_areas[facet_of(use)] += area(use).norm() / 3.0;

    double lost = 0.0;
    double between = 0.0;
    for (const auto& edge : edges) {
        const EdgeUse& use = edge.front();
        const double angle = angle_at(edge);
        if (angle > sharp_angle || angle < coplanar) continue;
        const Vector3d along = flat.vertices[as_index(use.high)] - flat.vertices[as_index(use.low)];
        const double length = along.norm();
        // The width across the edge: the triangle's height, or the mean width of its facet.
        const auto width_of = [&](const EdgeUse& side) {
            return std::max(2.0 * area(side).norm(), facet_areas[facet_of(side)]) / length;
        };
        const double width = std::min(width_of(use), width_of(edge.back()));
        // The circular segment over a chord of this width, where the next chord is rotated by this angle.
        const double volume = length * width * width * angle / 12.0;
        const bool hollow = area(use).cross(area(edge.back())).dot(along) * (use.forward ? 1.0 : -1.0) < 0.0;
        lost += hollow ? -volume : volume;
        between += volume;
    }
    const double whole = enclosed_volume(flat);
    return {lost / whole, std::min(1.0, between / whole)};
}

double miss_of(const ShapeError& error, double smoothing) {
    const auto beyond = [&](double change) {
        return change - std::clamp(change, std::min(0.0, smoothing), std::max(0.0, smoothing));
    };
    return std::max({std::abs(beyond(error.volume)) / most_volume, error.distance / most_distance,
                     std::abs(beyond(error.area)) / most_area});
}

}  // namespace samara
