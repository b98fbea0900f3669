#include "samara/kirchhoff/surfaces/thickness.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace samara {
namespace {

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
