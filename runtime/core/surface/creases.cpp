#include "samara/core/surface/creases.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "samara/core/base/numbers.hpp"
#include "samara/core/surface/curved_surface.hpp"
#include "samara/core/surface/surface_edges.hpp"

namespace samara {
namespace {

/// Returns the outward direction at the middle of a side.
Vector3d normal_at_side(const Surface& surface, const EdgeUse& use, bool flat) {
    const auto triangle = as_index(use.triangle);
    if (flat) return area_vector(surface, triangle);
    constexpr std::array<std::array<double, 2>, 3> middles = {{{0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}}};
    const auto& [u, v] = middles[as_index(use.side)];
    return normal_of_triangle(surface, triangle, u, v);
}

/// Returns the angle (rad) by which the normal of the surface, or of its flat corner triangles, changes at
/// each side of each triangle; pi where the surface ends.
std::vector<std::array<double, 3>> angles_of(const Surface& surface, bool flat) {
    std::vector<std::array<double, 3>> angles(surface.triangle_count(),
                                              {std::numbers::pi, std::numbers::pi, std::numbers::pi});
    const std::vector<EdgeUse> uses = edge_uses(surface);
    for (const auto& edge : edges_of(uses)) {
        if (edge.size() != 2) continue;
        const Vector3d one = normal_at_side(surface, edge[0], flat);
        const Vector3d other = normal_at_side(surface, edge[1], flat);
        const double angle = std::atan2(one.cross(other).norm(), one.dot(other));
        for (const EdgeUse& use : edge) {
            angles[as_index(use.triangle)][as_index(use.side)] = angle;
        }
    }
    return angles;
}

/// Returns for each vertex the largest such angle (rad) at an edge around it, sharp creases aside.
std::vector<double> largest_angles(const Surface& surface, const std::vector<std::array<double, 3>>& angles) {
    std::vector<double> most(surface.vertices.size(), 0.0);
    for (std::size_t t = 0; t < angles.size(); ++t) {
        for (std::size_t side = 0; side < 3; ++side) {
            if (angles[t][side] > sharp_angle) continue;
            for (const std::size_t end : {side, (side + 1) % 3}) {
                double& value = most[as_index(surface.corners[t][end])];
                value = std::max(value, angles[t][side]);
            }
        }
    }
    return most;
}

}  // namespace

Creases find_creases(const Surface& surface) {
    const std::vector<std::array<double, 3>> flat_angles = angles_of(surface, true);
    const std::vector<std::array<double, 3>> angles =
        surface.order() == 1 ? flat_angles : angles_of(surface, false);
    const std::vector<double> most = largest_angles(surface, flat_angles);
    const auto apex_angle = [&](std::size_t triangle, std::size_t side) {
        return most[as_index(surface.corners[triangle][(side + 2) % 3])];
    };
    Creases creases(surface.triangle_count(), {true, true, true});
    const std::vector<EdgeUse> uses = edge_uses(surface);
    for (const auto& edge : edges_of(uses)) {
        if (edge.size() != 2) continue;
        const auto triangle = as_index(edge[0].triangle);
        const auto side = as_index(edge[0].side);
        const double angle = angles[triangle][side];
        const double around = std::max(apex_angle(triangle, side),
                                       apex_angle(as_index(edge[1].triangle), as_index(edge[1].side)));
        // Between curved triangles the angles vary from edge to edge; between flat ones only at folds.
        const bool is_fold = std::min(angle, flat_angles[triangle][side]) > shallow_crease_angle &&
                             flat_angles[triangle][side] > shallow_crease_ratio * around;
        const bool is_crease = angle > sharp_angle || is_fold;
        for (const EdgeUse& use : edge) {
            creases[as_index(use.triangle)][as_index(use.side)] = is_crease;
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
            on_crease[as_index(surface.corners[t][side])] = true;
            on_crease[as_index(surface.corners[t][(side + 1) % 3])] = true;
        }
    }
    return on_crease;
}

}  // namespace samara
