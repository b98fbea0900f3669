#include "meshes/symmetry/image_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "meshes/remeshing/mesh_size_field.hpp"
#include "samara/core/surface/creases.hpp"
#include "samara/core/surface/curved_surface.hpp"
#include "samara/core/surface/surface_edges.hpp"

namespace samara {
namespace {

constexpr std::size_t most_points = 5000;
constexpr double points_over_the_area = 2000.0;
constexpr double coarsest_spacing = 0.05;
constexpr int subdivisions_of_curved_triangles = 4;

// Estimates how far flat triangles lie within the curved surface that they approximate (m). On a sphere,
// equilateral triangles of height h with the angle a between neighbours lie h a / 3 deep; a fifth more covers
// uneven ones.
double sagitta(const Surface& surface) {
    std::vector<double> depths;
    const std::vector<EdgeUse> uses = edge_uses(surface);
    for (const auto& edge : edges_of(uses)) {
        if (edge.size() != 2) continue;
        const Vector3d first = area_vector(surface, static_cast<std::size_t>(edge[0].triangle));
        const Vector3d second = area_vector(surface, static_cast<std::size_t>(edge[1].triangle));
        const double angle = std::atan2(first.cross(second).norm(), first.dot(second));
        if (angle > sharp_angle) continue;
        const double length = (surface.vertices[static_cast<std::size_t>(edge[0].high)] -
                               surface.vertices[static_cast<std::size_t>(edge[0].low)])
                                  .norm();
        const double height = 2.0 * std::max(first.norm(), second.norm()) / length;
        depths.push_back(height * angle / 2.5);
    }
    if (depths.empty()) return 0.0;
    // Not the largest, since a single dent would make the comparison insensitive.
    const auto place =
        depths.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(depths.size()));
    std::nth_element(depths.begin(), place, depths.end());
    return *place;
}

double size_of(const Surface& surface, const Vector3d& centre) {
    double size = 0.0;
    for (const Vector3d& vertex : surface.vertices) size = std::max(size, (vertex - centre).norm());
    return size;
}

std::vector<Vector3d> points_of(const Surface& surface, const Vector3d& centre) {
    std::vector<Vector3d> points;
    for (const Vector3d& vertex : surface.vertices) points.push_back(vertex - centre);
    double area = 0.0;
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) area += area_vector(surface, t).norm();
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        const double share = area_vector(surface, t).norm() / area;
        const int count = 1 + static_cast<int>(share * points_over_the_area);
        // The R2 sequence, folded into the triangle; it starts near the middle.
        double u = 1.0 / 3.0;
        double v = 1.0 / 3.0;
        for (int i = 0; i < count; ++i) {
            const bool outside = u + v > 1.0;
            points.push_back(point_of_triangle(surface, t, outside ? 1.0 - u : u, outside ? 1.0 - v : v) -
                             centre);
            u = std::fmod(u + 0.7548776662466927, 1.0);
            v = std::fmod(v + 0.5698402909980532, 1.0);
        }
    }
    // In random order an image that does not fit is detected early. std::shuffle differs between libraries.
    std::mt19937 generator(1);
    for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[generator() % i]);
    if (points.size() > most_points) points.resize(most_points);
    return points;
}

TriangleTree tree_of(const Surface& surface, const Vector3d& centre) {
    Surface flat = flattened(surface, subdivisions_of_curved_triangles);
    for (Vector3d& vertex : flat.vertices) vertex -= centre;
    return {std::move(flat.vertices), std::move(flat.corners)};
}

}  // namespace

double faceting(const Surface& surface, const Vector3d& centre) {
    return surface.order() == 1 ? std::min(coarsest_spacing, sagitta(surface) / size_of(surface, centre))
                                : 0.0;
}

ImageComparison::ImageComparison(const Surface& surface, const Vector3d& centre, double tolerance)
    : size_(size_of(surface, centre)),
      tolerance_(std::min(coarsest_spacing, std::max(tolerance, faceting(surface, centre)))),
      points_(points_of(surface, centre)),
      tree_(tree_of(surface, centre)) {}

bool ImageComparison::is_symmetry(const Matrix3d& element, double slack, std::size_t points) const {
    const auto end = points_.begin() + static_cast<std::ptrdiff_t>(std::min(points, points_.size()));
    return std::all_of(points_.begin(), end, [&](const Vector3d& point) {
        return tree_.is_within(element * point, slack * tolerance_ * size_);
    });
}

double ImageComparison::mean_distance(const Matrix3d& element, std::size_t points, double enough) const {
    const std::size_t count = std::min(points, points_.size());
    const double whole = static_cast<double>(count) * size_;
    double sum = 0.0;
    for (std::size_t i = 0; i < count && sum <= enough * whole; ++i)
        sum += std::sqrt(tree_.nearest(element * points_[i]).squared_distance);
    return sum / whole;
}

}  // namespace samara
