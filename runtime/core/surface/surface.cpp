#include "samara/core/surface/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace samara {

Vector3d area_vector(const Surface& surface, std::size_t triangle) {
    const auto& [a, b, c] = surface.corners[triangle];
    const auto vertex = [&](std::int32_t index) { return surface.vertices[static_cast<std::size_t>(index)]; };
    return 0.5 * (vertex(b) - vertex(a)).cross(vertex(c) - vertex(a));
}

Vector3d triangle_centroid(const Surface& surface, std::size_t triangle) {
    Vector3d sum = Vector3d::Zero();
    for (const std::int32_t index : surface.corners[triangle]) {
        sum += surface.vertices[static_cast<std::size_t>(index)];
    }
    return sum / 3.0;
}

double longest_edge(const Surface& surface, std::size_t triangle) {
    const auto& corners = surface.corners[triangle];
    double longest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vector3d edge = surface.vertices[static_cast<std::size_t>(corners[(i + 1) % 3])] -
                              surface.vertices[static_cast<std::size_t>(corners[i])];
        longest = std::max(longest, edge.norm());
    }
    return longest;
}

double surface_area(const Surface& surface) {
    double area = 0.0;
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) area += area_vector(surface, t).norm();
    return area;
}

double projected_area(const Surface& surface, const Vector3d& direction) {
    double area = 0.0;
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        area += std::abs(area_vector(surface, t).dot(direction));
    }
    return 0.5 * area;
}

double reference_length(double surface_area) {
    return std::sqrt(surface_area / std::numbers::pi);
}

}  // namespace samara
