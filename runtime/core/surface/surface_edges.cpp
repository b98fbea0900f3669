#include "samara/core/surface/surface_edges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include <Eigen/Geometry>

namespace samara {
namespace {

const Vector3d& corner(const Surface& surface, std::int32_t triangle, std::size_t index) {
    const std::int32_t vertex = surface.corners[static_cast<std::size_t>(triangle)][index];
    return surface.vertices[static_cast<std::size_t>(vertex)];
}

bool is_forward(const Surface& surface, std::int32_t triangle, std::int32_t other, std::size_t side) {
    const auto& mine = surface.corners[static_cast<std::size_t>(triangle)];
    const auto& its = surface.corners[static_cast<std::size_t>(other)];
    const std::int32_t from = mine[side];
    const std::int32_t to = mine[(side + 1) % 3];
    for (std::size_t i = 0; i < 3; ++i) {
        // Neighbours that agree run along the common edge in opposite directions.
        if (its[i] == to && its[(i + 1) % 3] == from) return true;
    }
    return false;
}

// Returns whether the component encloses the point, by its solid angle there over 4 pi, whatever its
// orientation: 1 inside, 0 outside. van Oosterom and Strackee, IEEE Trans. Biomed. Eng. 30(2), 1983.
bool encloses(const Surface& surface, const Component& component, const Vector3d& point) {
    double angle = 0.0;
    for (const std::int32_t t : component.triangles) {
        const Vector3d a = corner(surface, t, 0) - point;
        const Vector3d b = corner(surface, t, 1) - point;
        const Vector3d c = corner(surface, t, 2) - point;
        const double la = a.norm();
        const double lb = b.norm();
        const double lc = c.norm();
        angle +=
            2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return std::abs(angle) > 2.0 * std::numbers::pi;
}

Eigen::AlignedBox3d box_of(const Surface& surface, const Component& component) {
    Eigen::AlignedBox3d box;
    for (const std::int32_t t : component.triangles) {
        for (std::size_t i = 0; i < 3; ++i) box.extend(corner(surface, t, i));
    }
    return box;
}

}  // namespace

std::vector<EdgeUse> edge_uses(const Surface& surface) {
    std::vector<EdgeUse> uses;
    uses.reserve(3 * surface.triangle_count());
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        for (std::size_t side = 0; side < 3; ++side) {
            const std::int32_t from = surface.corners[t][side];
            const std::int32_t to = surface.corners[t][(side + 1) % 3];
            uses.push_back({std::min(from, to), std::max(from, to), static_cast<std::int32_t>(t),
                            static_cast<std::int32_t>(side), from < to});
        }
    }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return std::tie(a.low, a.high, a.triangle, a.side) < std::tie(b.low, b.high, b.triangle, b.side);
    });
    return uses;
}

std::vector<std::span<const EdgeUse>> edges_of(const std::vector<EdgeUse>& uses) {
    std::vector<std::span<const EdgeUse>> edges;
    for (std::size_t first = 0; first < uses.size();) {
        std::size_t last = first + 1;
        while (last < uses.size() && uses[last].low == uses[first].low &&
               uses[last].high == uses[first].high) {
            ++last;
        }
        edges.emplace_back(&uses[first], last - first);
        first = last;
    }
    return edges;
}

std::vector<std::array<std::int32_t, 3>> neighbours(const Surface& surface) {
    std::vector<std::array<std::int32_t, 3>> others(surface.triangle_count(), {-1, -1, -1});
    const std::vector<EdgeUse> uses = edge_uses(surface);
    for (const auto& edge : edges_of(uses)) {
        if (edge.size() != 2) continue;
        for (std::size_t i = 0; i < 2; ++i) {
            const EdgeUse& use = edge[i];
            others[static_cast<std::size_t>(use.triangle)][static_cast<std::size_t>(use.side)] =
                edge[1 - i].triangle;
        }
    }
    return others;
}

void reverse_triangle(Surface& surface, std::size_t triangle) {
    std::swap(surface.corners[triangle][1], surface.corners[triangle][2]);
    if (surface.order() == 2) std::swap(surface.edge_nodes[triangle][0], surface.edge_nodes[triangle][2]);
}

std::vector<Component> components(const Surface& surface) {
    const auto others = neighbours(surface);
    enum class State : char { unseen, with, against };
    std::vector<State> state(surface.triangle_count(), State::unseen);
    std::vector<Component> pieces;
    for (std::size_t seed = 0; seed < surface.triangle_count(); ++seed) {
        if (state[seed] != State::unseen) continue;
        Component piece;
        piece.triangles.push_back(static_cast<std::int32_t>(seed));
        state[seed] = State::with;
        for (std::size_t next = 0; next < piece.triangles.size(); ++next) {
            const std::int32_t t = piece.triangles[next];
            const State mine = state[static_cast<std::size_t>(t)];
            for (std::size_t side = 0; side < 3; ++side) {
                const std::int32_t other = others[static_cast<std::size_t>(t)][side];
                if (other < 0 || state[static_cast<std::size_t>(other)] != State::unseen) continue;
                const bool agrees = is_forward(surface, t, other, side);
                const bool with = agrees == (mine == State::with);
                state[static_cast<std::size_t>(other)] = with ? State::with : State::against;
                piece.triangles.push_back(other);
                if (!with) piece.against.push_back(other);
            }
        }
        pieces.push_back(std::move(piece));
    }
    return pieces;
}

double enclosed_volume(const Surface& surface, const Component& component) {
    const Vector3d origin = corner(surface, component.triangles.front(), 0);
    double volume = 0.0;
    for (const std::int32_t t : component.triangles) {
        const Vector3d a = corner(surface, t, 0) - origin;
        const Vector3d b = corner(surface, t, 1) - origin;
        const Vector3d c = corner(surface, t, 2) - origin;
        volume += a.dot(b.cross(c)) / 6.0;
    }
    return volume;
}

std::vector<int> nesting_depths(const Surface& surface, const std::vector<Component>& pieces) {
    std::vector<Eigen::AlignedBox3d> boxes;
    boxes.reserve(pieces.size());
    for (const Component& piece : pieces) boxes.push_back(box_of(surface, piece));
    std::vector<int> depths(pieces.size(), 0);
    for (std::size_t inner = 0; inner < pieces.size(); ++inner) {
        const Vector3d& point = corner(surface, pieces[inner].triangles.front(), 0);
        for (std::size_t outer = 0; outer < pieces.size(); ++outer) {
            if (outer == inner || !boxes[outer].contains(boxes[inner])) continue;
            if (encloses(surface, pieces[outer], point)) ++depths[inner];
        }
    }
    return depths;
}

void orient_outwards(Surface& surface) {
    const std::vector<Component> pieces = components(surface);
    for (const Component& piece : pieces) {
        for (const std::int32_t t : piece.against) reverse_triangle(surface, static_cast<std::size_t>(t));
    }
    const std::vector<int> depths = nesting_depths(surface, pieces);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        const bool is_cavity = depths[i] % 2 == 1;
        if ((enclosed_volume(surface, pieces[i]) < 0.0) == is_cavity) continue;
        for (const std::int32_t t : pieces[i].triangles)
            reverse_triangle(surface, static_cast<std::size_t>(t));
    }
}

}  // namespace samara
