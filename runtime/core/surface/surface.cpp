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

Vector3d closest_point_of_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b,
                                   const Vector3d& c) noexcept {
    const Vector3d ab = b - a;
    const Vector3d ac = c - a;
    const Vector3d ap = p - a;
    const double d1 = ab.dot(ap);
    const double d2 = ac.dot(ap);
    if (d1 <= 0.0 && d2 <= 0.0) return a;
    const Vector3d bp = p - b;
    const double d3 = ab.dot(bp);
    const double d4 = ac.dot(bp);
    if (d3 >= 0.0 && d4 <= d3) return b;
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return a + d1 / (d1 - d3) * ab;
    const Vector3d cp = p - c;
    const double d5 = ab.dot(cp);
    const double d6 = ac.dot(cp);
    if (d6 >= 0.0 && d5 <= d6) return c;
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return a + d2 / (d2 - d6) * ac;
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        return b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b);
    }
    const double sum = va + vb + vc;
    return a + vb / sum * ab + vc / sum * ac;
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
