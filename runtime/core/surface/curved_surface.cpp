#include "samara/core/surface/curved_surface.hpp"

#include <algorithm>
#include <array>

#include "samara/core/surface/surface_edges.hpp"

namespace samara {
namespace {

std::array<Vector3d, 6> nodes_of(const Surface& surface, std::size_t triangle) {
    std::array<Vector3d, 6> nodes;
    for (std::size_t i = 0; i < 3; ++i) {
        nodes[i] = surface.vertices[static_cast<std::size_t>(surface.corners[triangle][i])];
        nodes[i + 3] = surface.vertices[static_cast<std::size_t>(surface.edge_nodes[triangle][i])];
    }
    return nodes;
}

Vector3d normal_at(const std::array<Vector3d, 6>& n, double u, double v) {
    const double w = 1.0 - u - v;
    const Vector3d by_u =
        (1.0 - 4.0 * w) * n[0] + (4.0 * u - 1.0) * n[1] + 4.0 * ((w - u) * n[3] + v * (n[4] - n[5]));
    const Vector3d by_v =
        (1.0 - 4.0 * w) * n[0] + (4.0 * v - 1.0) * n[2] + 4.0 * ((w - v) * n[5] + u * (n[4] - n[3]));
    return by_u.cross(by_v);
}

bool is_overturned(const Surface& surface, std::size_t triangle) {
    constexpr std::array<std::array<double, 2>, 6> places = {
        {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.5, 0.0}, {0.5, 0.5}, {0.0, 0.5}}};
    const std::array<Vector3d, 6> nodes = nodes_of(surface, triangle);
    return std::any_of(places.begin(), places.end(), [&](const auto& place) {
        return normal_at(nodes, place[0], place[1]).dot(area_vector(surface, triangle)) <= 0.0;
    });
}

}  // namespace

Vector3d point_of_triangle(const Surface& surface, std::size_t triangle, double u, double v) {
    const double w = 1.0 - u - v;
    if (surface.order() == 1) {
        const auto& [a, b, c] = surface.corners[triangle];
        return w * surface.vertices[static_cast<std::size_t>(a)] +
               u * surface.vertices[static_cast<std::size_t>(b)] +
               v * surface.vertices[static_cast<std::size_t>(c)];
    }
    const std::array<Vector3d, 6> n = nodes_of(surface, triangle);
    return w * (2.0 * w - 1.0) * n[0] + u * (2.0 * u - 1.0) * n[1] + v * (2.0 * v - 1.0) * n[2] +
           4.0 * (w * u * n[3] + u * v * n[4] + v * w * n[5]);
}

Vector3d normal_of_triangle(const Surface& surface, std::size_t triangle, double u, double v) {
    if (surface.order() == 1) return 2.0 * area_vector(surface, triangle);
    return normal_at(nodes_of(surface, triangle), u, v);
}

double enclosed_volume(const Surface& surface) {
    const Vector3d origin = surface.vertices.front();
    const auto under = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
        const auto at = [&](std::int32_t i) -> Vector3d {
            return surface.vertices[static_cast<std::size_t>(i)] - origin;
        };
        return at(a).dot(at(b).cross(at(c))) / 6.0;
    };
    double volume = 0.0;
    for (std::size_t t = 0; t < surface.corners.size(); ++t) {
        const auto& [a, b, c] = surface.corners[t];
        if (surface.order() == 1) {
            volume += under(a, b, c);
            continue;
        }
        const auto& [ab, bc, ca] = surface.edge_nodes[t];
        volume += under(a, ab, ca) + under(ab, b, bc) + under(ca, bc, c) + under(ab, bc, ca);
    }
    return volume;
}

Surface flattened(const Surface& surface, int subdivisions) {
    if (surface.order() == 1) return surface;
    Surface flat;
    const auto add = [&](std::size_t t, std::array<std::array<int, 2>, 3> corners) {
        const auto first = static_cast<std::int32_t>(flat.vertices.size());
        for (const auto& [i, j] : corners) {
            flat.vertices.push_back(point_of_triangle(surface, t, static_cast<double>(i) / subdivisions,
                                                      static_cast<double>(j) / subdivisions));
        }
        flat.corners.push_back({first, first + 1, first + 2});
    };
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        for (int i = 0; i < subdivisions; ++i) {
            for (int j = 0; i + j < subdivisions; ++j) {
                add(t, {{{i, j}, {i + 1, j}, {i, j + 1}}});
                if (i + j + 1 < subdivisions) add(t, {{{i + 1, j}, {i + 1, j + 1}, {i, j + 1}}});
            }
        }
    }
    return flat;
}

Surface flattened_surface(const Surface& surface) {
    if (surface.order() == 1) return surface;
    Surface flat;
    flat.vertices = surface.vertices;
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        const auto& [a, b, c] = surface.corners[t];
        const auto& [ab, bc, ca] = surface.edge_nodes[t];
        flat.corners.push_back({a, ab, ca});
        flat.corners.push_back({ab, b, bc});
        flat.corners.push_back({ca, bc, c});
        flat.corners.push_back({ab, bc, ca});
    }
    return flat;
}

Surface with_straight_edge_nodes(const Surface& surface) {
    Surface result = without_edge_nodes(surface);
    result.edge_nodes.resize(result.triangle_count());
    const std::vector<EdgeUse> uses = edge_uses(result);
    for (const auto& edge : edges_of(uses)) {
        const auto node = static_cast<std::int32_t>(result.vertices.size());
        const Vector3d middle = 0.5 * (result.vertices[static_cast<std::size_t>(edge.front().low)] +
                                       result.vertices[static_cast<std::size_t>(edge.front().high)]);
        result.vertices.push_back(middle);
        for (const EdgeUse& use : edge) {
            result.edge_nodes[static_cast<std::size_t>(use.triangle)][static_cast<std::size_t>(use.side)] =
                node;
        }
    }
    return result;
}

Surface without_edge_nodes(const Surface& surface) {
    Surface result;
    std::vector<std::int32_t> new_index(surface.vertices.size(), -1);
    for (const auto& triangle : surface.corners) {
        auto& corners = result.corners.emplace_back();
        for (std::size_t i = 0; i < 3; ++i) {
            const auto old = static_cast<std::size_t>(triangle[i]);
            if (new_index[old] < 0) {
                new_index[old] = static_cast<std::int32_t>(result.vertices.size());
                result.vertices.push_back(surface.vertices[old]);
            }
            corners[i] = new_index[old];
        }
    }
    return result;
}

bool has_straight_edges(const Surface& surface) {
    constexpr double rounding = 1e-6;
    for (std::size_t t = 0; t < surface.edge_nodes.size(); ++t) {
        const std::array<Vector3d, 6> nodes = nodes_of(surface, t);
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector3d& from = nodes[i];
            const Vector3d& to = nodes[(i + 1) % 3];
            if ((nodes[i + 3] - 0.5 * (from + to)).norm() > rounding * (to - from).norm()) return false;
        }
    }
    return true;
}

std::vector<std::int32_t> overturned_triangles(const Surface& surface) {
    std::vector<std::int32_t> overturned;
    for (std::size_t t = 0; t < surface.edge_nodes.size(); ++t) {
        if (is_overturned(surface, t)) overturned.push_back(static_cast<std::int32_t>(t));
    }
    return overturned;
}

void straighten_overturned(Surface& surface) {
    // A straightened edge may overturn the triangle on its other side: three rounds suffice.
    for (int round = 0; round < 3; ++round) {
        for (std::size_t t = 0; t < surface.edge_nodes.size(); ++t) {
            if (!is_overturned(surface, t)) continue;
            for (std::size_t i = 0; i < 3; ++i) {
                const auto corner = [&](std::size_t k) -> const Vector3d& {
                    return surface.vertices[static_cast<std::size_t>(surface.corners[t][k % 3])];
                };
                surface.vertices[static_cast<std::size_t>(surface.edge_nodes[t][i])] =
                    0.5 * (corner(i) + corner(i + 1));
            }
        }
    }
}

}  // namespace samara
