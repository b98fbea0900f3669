#include "samara/core/surface/creases.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "samara/core/base/numbers.hpp"
#include "samara/core/surface/curved_surface.hpp"
#include "samara/core/surface/surface_edges.hpp"

namespace samara {
namespace {

/// The outward direction at the middle of a side.
Vector3d normal_at_side(const Surface& surface, const EdgeUse& use, bool flat) {
    const auto triangle = as_index(use.triangle);
    if (flat) return area_vector(surface, triangle);
    constexpr std::array<std::array<double, 2>, 3> middles = {{{0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}}};
    const auto& [u, v] = middles[as_index(use.side)];
    return normal_of_triangle(surface, triangle, u, v);
}

/// By how much the surface, or that of its flat corner triangles, turns (radians) at each side of each
/// triangle; pi where it ends.
std::vector<std::array<double, 3>> turns_of(const Surface& surface, bool flat) {
    std::vector<std::array<double, 3>> turns(surface.triangle_count(),
                                             {std::numbers::pi, std::numbers::pi, std::numbers::pi});
    const std::vector<EdgeUse> uses = edge_uses(surface);
    for (const auto& edge : edges_of(uses)) {
        if (edge.size() != 2) continue;
        const Vector3d one = normal_at_side(surface, edge[0], flat);
        const Vector3d other = normal_at_side(surface, edge[1], flat);
        const double turn = std::atan2(one.cross(other).norm(), one.dot(other));
        for (const EdgeUse& use : edge) {
            turns[as_index(use.triangle)][as_index(use.side)] = turn;
        }
    }
    return turns;
}

/// For each vertex the most that the surface turns at an edge around it, sharp creases aside.
std::vector<double> most_turns(const Surface& surface, const std::vector<std::array<double, 3>>& turns) {
    std::vector<double> most(surface.vertices.size(), 0.0);
    for (std::size_t t = 0; t < turns.size(); ++t) {
        for (std::size_t side = 0; side < 3; ++side) {
            if (turns[t][side] > sharp_angle) continue;
            for (const std::size_t end : {side, (side + 1) % 3}) {
                double& value = most[as_index(surface.corners[t][end])];
                value = std::max(value, turns[t][side]);
            }
        }
    }
    return most;
}

}  // namespace

Creases find_creases(const Surface& surface) {
    const std::vector<std::array<double, 3>> flat_turns = turns_of(surface, true);
    const std::vector<std::array<double, 3>> turns =
        surface.order() == 1 ? flat_turns : turns_of(surface, false);
    const std::vector<double> most = most_turns(surface, flat_turns);
    const auto apex_turn = [&](std::size_t triangle, std::size_t side) {
        return most[as_index(surface.corners[triangle][(side + 2) % 3])];
    };
    Creases creases(surface.triangle_count(), {true, true, true});
    const std::vector<EdgeUse> uses = edge_uses(surface);
    for (const auto& edge : edges_of(uses)) {
        if (edge.size() != 2) continue;
        const auto triangle = as_index(edge[0].triangle);
        const auto side = as_index(edge[0].side);
        const double turn = turns[triangle][side];
        const double around = std::max(apex_turn(triangle, side),
                                       apex_turn(as_index(edge[1].triangle), as_index(edge[1].side)));
        // Of curved triangles the turns vary from edge to edge; of flat ones only at folds.
        const bool is_fold = std::min(turn, flat_turns[triangle][side]) > shallow_crease_angle &&
                             flat_turns[triangle][side] > shallow_crease_ratio * around;
        const bool is_crease = turn > sharp_angle || is_fold;
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
