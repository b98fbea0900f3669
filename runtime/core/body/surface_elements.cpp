#include "samara/core/body/surface_elements.hpp"

#include <algorithm>
#include <cstddef>

namespace samara {
namespace {

/// The gradient of the linear function that is 1 at the triangle's corner k and 0 at the others.
Vector3d gradient_of_corner(const Surface& surface, std::size_t triangle, std::size_t k,
                            const Vector3d& area) {
    const auto corner = [&](std::size_t i) -> const Vector3d& {
        return surface.vertices[static_cast<std::size_t>(surface.corners[triangle][i % 3])];
    };
    return area.cross(corner(k + 2) - corner(k + 1)) / (2.0 * area.squaredNorm());
}

}  // namespace

std::vector<SurfaceElement> surface_elements(const SurfaceLoads& loads) {
    const Surface& surface = loads.surface;
    std::vector<SurfaceElement> elements(surface.triangle_count());
    for (std::size_t t = 0; t < elements.size(); ++t) {
        const Vector3d area = area_vector(surface, t);
        SurfaceElement& element = elements[t];
        element.place = triangle_centroid(surface, t);
        element.area = area.norm();
        if (!(element.area > 0.0)) continue;
        element.normal = area / element.area;
        element.surface_velocity = element.normal * element.normal.transpose() - Matrix3d::Identity();
        for (std::size_t k = 0; k < 3; ++k) {
            const auto vertex = static_cast<std::size_t>(surface.corners[t][k]);
            element.surface_velocity +=
                gradient_of_corner(surface, t, k, area) * loads.potentials[vertex].transpose();
        }
    }
    return elements;
}

double pressure_on(const SurfaceElement& element, const Vector3d& direction,
                   const SurfacePressure& pressure) {
    const double along = element.normal.dot(direction);
    const double attached =
        std::max(1.0 - (element.surface_velocity * direction).squaredNorm(), pressure.base);
    if (along >= 0.0) return attached;
    const double separated = std::min(1.0, -along / pressure.separation_sine);
    return separated * pressure.base + (1.0 - separated) * std::min(0.0, attached);
}

}  // namespace samara
