#include "meshes/image_test.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "meshes/curved_surface.hpp"
#include "meshes/mesh_size_field.hpp"
#include "meshes/surface_edges.hpp"

namespace samara {
namespace {

constexpr std::size_t most_points = 4000;
constexpr double loosest_tolerance = 0.05;
constexpr int subdivisions_of_curved_triangles = 4;

// How far flat triangles may lie within the curved surface that they stand for (m): the arc over a triangle's
// height h that turns by the angle between neighbours has the sagitta h * angle / 8; twice that covers the
// triangle's middle.
double sagitta(const Surface& surface) {
    double largest = 0.0;
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
        largest = std::max(largest, height * angle / 4.0);
    }
    return largest;
}

std::vector<Vector3d> points_of(const Surface& surface, const Vector3d& centre) {
    std::vector<Vector3d> points;
    for (const Vector3d& vertex : surface.vertices) points.push_back(vertex - centre);
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        points.push_back(point_of_triangle(surface, t, 1.0 / 3.0, 1.0 / 3.0) - centre);
    }
    // In mixed order an image that does not fit is found out early. std::shuffle differs between libraries.
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

ImageTest::ImageTest(const Surface& surface, const Vector3d& centre, double tolerance)
    : tolerance_(tolerance), points_(points_of(surface, centre)), tree_(tree_of(surface, centre)) {
    for (const Vector3d& vertex : surface.vertices) size_ = std::max(size_, (vertex - centre).norm());
    if (surface.order() == 1) {
        tolerance_ = std::max(tolerance_, std::min(loosest_tolerance, sagitta(surface) / size_));
    }
}

bool ImageTest::is_symmetry(const Matrix3d& element, double slack) const {
    return std::all_of(points_.begin(), points_.end(), [&](const Vector3d& point) {
        return tree_.is_within(element * point, slack * tolerance_ * size_);
    });
}

double ImageTest::mean_distance(const Matrix3d& element, std::size_t points) const {
    const std::size_t count = std::min(points, points_.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i)
        sum += std::sqrt(tree_.nearest(element * points_[i]).squared_distance);
    return sum / (static_cast<double>(count) * size_);
}

}  // namespace samara
