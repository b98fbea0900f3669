#include "samara/kirchhoff/panels/flat_triangle.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"

namespace samara {

FlatTriangle flat_triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    FlatTriangle triangle;
    triangle.corners = {a, b, c};
    triangle.centroid = (a + b + c) / 3.0;
    const Vector3d twice_area = (b - a).cross(c - a);
    triangle.area = 0.5 * twice_area.norm();
    triangle.normal = twice_area / (2.0 * triangle.area);
    triangle.radius = 0.0;
    for (std::size_t e = 0; e < 3; ++e) {
        const Vector3d edge = triangle.corners[(e + 1) % 3] - triangle.corners[e];
        triangle.lengths[e] = edge.norm();
        triangle.tangents[e] = edge / triangle.lengths[e];
        triangle.outward[e] = triangle.tangents[e].cross(triangle.normal);
        triangle.radius = std::max(triangle.radius, (triangle.corners[e] - triangle.centroid).norm());
    }
    return triangle;
}

std::vector<FlatTriangle> flat_triangles(const Surface& surface) {
    std::vector<FlatTriangle> triangles;
    triangles.reserve(surface.triangle_count());
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        const auto corner = [&](std::size_t i) {
            return surface.vertices[static_cast<std::size_t>(surface.corners[t][i])];
        };
        triangles.push_back(flat_triangle(corner(0), corner(1), corner(2)));
        const FlatTriangle& triangle = triangles.back();
        // Also false where a coordinate is not a number.
        if (!(triangle.area > 1e-12 * triangle.radius * triangle.radius)) {
            throw Error(fmt::format(
                "triangle {} has no area or is not finite; mesh the shape again with 'samara mesh'", t));
        }
    }
    return triangles;
}

}  // namespace samara
