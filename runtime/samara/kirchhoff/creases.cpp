#include "samara/kirchhoff/creases.hpp"

#include <algorithm>
#include <cmath>

#include "samara/body/curved_surface.hpp"
#include "samara/body/surface_edges.hpp"

namespace samara {
namespace {

/// The outward direction at the middle of a side.
Vector3d normal_at_side(const Surface& surface, const EdgeUse& use) {
    const auto triangle = static_cast<std::size_t>(use.triangle);
    if (surface.order() == 1) return area_vector(surface, triangle);
    constexpr std::array<std::array<double, 2>, 3> middles = {{{0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}}};
    const auto& [u, v] = middles[static_cast<std::size_t>(use.side)];
    return normal_of_triangle(surface, triangle, u, v);
}

}  // namespace

Creases find_creases(const Surface& surface) {
    Creases creases(surface.triangle_count(), {true, true, true});
    const std::vector<EdgeUse> uses = edge_uses(surface);
    for (const auto& edge : edges_of(uses)) {
        if (edge.size() != 2) continue;
        const Vector3d one = normal_at_side(surface, edge[0]);
        const Vector3d other = normal_at_side(surface, edge[1]);
        const bool is_crease = std::atan2(one.cross(other).norm(), one.dot(other)) > crease_angle;
        for (const EdgeUse& use : edge) {
            creases[static_cast<std::size_t>(use.triangle)][static_cast<std::size_t>(use.side)] = is_crease;
        }
    }
    return creases;
}

bool any_crease(const Creases& creases) {
    return std::any_of(creases.begin(), creases.end(),
                       [](const auto& sides) { return sides[0] || sides[1] || sides[2]; });
}

std::vector<bool> vertices_on_creases(const Surface& surface, const Creases& creases) {
    std::vector<bool> on_crease(surface.vertices.size(), false);
    for (std::size_t t = 0; t < creases.size(); ++t) {
        for (std::size_t side = 0; side < 3; ++side) {
            if (!creases[t][side]) continue;
            on_crease[static_cast<std::size_t>(surface.corners[t][side])] = true;
            on_crease[static_cast<std::size_t>(surface.corners[t][(side + 1) % 3])] = true;
        }
    }
    return on_crease;
}

}  // namespace samara
