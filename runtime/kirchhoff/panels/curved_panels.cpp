#include "samara/kirchhoff/panels/curved_panels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/parallel_for.hpp"

namespace samara {
namespace {

std::size_t at(std::int32_t index) {
    return static_cast<std::size_t>(index);
}

/// Interleaves the bits of the three coordinates, ten each (G. M. Morton's order).
std::uint32_t morton_code(const Vector3d& share_of_box) {
    std::uint32_t code = 0;
    for (std::uint32_t bit = 10; bit-- > 0;) {
        for (const double share : share_of_box) {
            const auto step = static_cast<std::uint32_t>(std::clamp(share, 0.0, 1.0) * 1023.0);
            code = (code << 1U) | ((step >> bit) & 1U);
        }
    }
    return code;
}

/// Returns new numbers of the vertices along the curve; -1 for those without a triangle.
std::vector<std::int32_t> renumbered(const Surface& surface, std::vector<Vector3d>& nodes) {
    std::vector<char> used(surface.vertices.size(), 0);
    Eigen::AlignedBox3d box;
    const auto use = [&](std::int32_t vertex) {
        used[at(vertex)] = 1;
        box.extend(surface.vertices[at(vertex)]);
    };
    for (const auto& corners : surface.corners) std::for_each(corners.begin(), corners.end(), use);
    for (const auto& middles : surface.edge_nodes) std::for_each(middles.begin(), middles.end(), use);
    std::vector<std::pair<std::uint32_t, std::size_t>> order;
    const double width = std::max(box.sizes().maxCoeff(), std::numeric_limits<double>::min());
    for (std::size_t i = 0; i < used.size(); ++i) {
        if (used[i] != 0) order.emplace_back(morton_code((surface.vertices[i] - box.min()) / width), i);
    }
    std::sort(order.begin(), order.end());
    std::vector<std::int32_t> numbers(used.size(), -1);
    for (const auto& [code, vertex] : order) {
        numbers[vertex] = static_cast<std::int32_t>(nodes.size());
        nodes.push_back(surface.vertices[vertex]);
    }
    return numbers;
}

CurvedPanel make_panel(const std::array<std::int32_t, 6>& numbers, const std::vector<Vector3d>& nodes) {
    std::array<Vector3d, 6> x;
    for (std::size_t a = 0; a < 6; ++a) x[a] = nodes[at(numbers[a])];
    CurvedPanel panel;
    panel.nodes = numbers;
    panel.coefficients = {x[0],
                          -3.0 * x[0] - x[1] + 4.0 * x[3],
                          -3.0 * x[0] - x[2] + 4.0 * x[5],
                          2.0 * x[0] + 2.0 * x[1] - 4.0 * x[3],
                          4.0 * (x[0] - x[3] + x[4] - x[5]),
                          2.0 * x[0] + 2.0 * x[2] - 4.0 * x[5]};
    panel.centre = panel.place(1.0 / 3.0, 1.0 / 3.0);
    for (const Vector3d& node : x) panel.radius = std::max(panel.radius, (node - panel.centre).norm());
    return panel;
}

/// Throws Error where the area normal vanishes: then two nodes are at one place, or an edge node far from its
/// edge's middle.
void require_regular(const CurvedPanel& panel, std::size_t triangle) {
    const double least_area = 1e-12 * panel.radius * panel.radius;
    for (const auto& [p, q] : node_coordinates) {
        // Not so either where a coordinate is not a number.
        if (panel.area_normal(p, q).norm() > least_area) continue;
        throw Error(
            fmt::format("triangle {} has no area, an edge node far from the middle of its edge or a "
                        "coordinate that is not finite; mesh the shape again with 'samara mesh'",
                        triangle));
    }
}

void mark_bent(CurvedPanel& panel) {
    constexpr double most_change = 1.5;
    std::array<Vector3d, 6> normals;
    double least = HUGE_VAL;
    for (std::size_t a = 0; a < 6; ++a) {
        normals[a] = panel.area_normal(node_coordinates[a][0], node_coordinates[a][1]);
        least = std::min(least, normals[a].norm());
    }
    for (const Vector3d& normal : normals) {
        for (const Vector3d& other : normals) {
            panel.bent = panel.bent || (normal - other).norm() > most_change * least;
        }
    }
}

/// Returns the solid angle of three unit vectors (van Oosterom and Strackee 1983), signed by their sense.
double solid_angle(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
    return 2.0 * std::atan2(a.dot(b.cross(c)), 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
}

/// Returns the solid angle between `inward` and the directions in which the panel leaves its node a: the
/// sector between two tangents at a corner, and two such sectors, split at the opposite corner, at the middle
/// of an edge.
double sector_angle(const CurvedPanel& panel, std::size_t a, const Vector3d& inward) {
    const Eigen::Matrix<double, 3, 2> tangents =
        panel.tangents(node_coordinates[a][0], node_coordinates[a][1]);
    const Vector3d along_p = tangents.col(0);
    const Vector3d along_q = tangents.col(1);
    const Vector3d across = along_q - along_p;
    const auto sector = [&](const Vector3d& first, const Vector3d& last) {
        return solid_angle(inward, first.normalized(), last.normalized());
    };
    const auto half_plane = [&](const Vector3d& first, const Vector3d& middle) {
        return sector(first, middle) + sector(middle, -first);
    };
    switch (a) {
        case 0:
            return sector(along_p, along_q);
        case 1:
            return sector(across, -along_p);
        case 2:
            return sector(-along_q, -across);
        case 3:
            return half_plane(along_p, along_q - 0.5 * along_p);
        case 4:
            return half_plane(across, -0.5 * (along_p + along_q));
        default:
            return half_plane(-along_q, along_p - 0.5 * along_q);
    }
}

}  // namespace

Vector3d CurvedPanel::place(double p, double q) const {
    const auto& c = coefficients;
    return c[0] + p * (c[1] + p * c[3] + q * c[4]) + q * (c[2] + q * c[5]);
}

Eigen::Matrix<double, 3, 2> CurvedPanel::tangents(double p, double q) const {
    const auto& c = coefficients;
    Eigen::Matrix<double, 3, 2> result;
    result << c[1] + 2.0 * p * c[3] + q * c[4], c[2] + p * c[4] + 2.0 * q * c[5];
    return result;
}

Vector3d CurvedPanel::area_normal(double p, double q) const {
    const Eigen::Matrix<double, 3, 2> both = tangents(p, q);
    return both.col(0).cross(both.col(1));
}

std::array<double, 6> node_functions(double p, double q) {
    const double r = 1.0 - p - q;
    return {r * (2.0 * r - 1.0), p * (2.0 * p - 1.0), q * (2.0 * q - 1.0),
            4.0 * r * p,         4.0 * p * q,         4.0 * q * r};
}

CurvedPanels make_curved_panels(const Surface& surface) {
    CurvedPanels result;
    const std::vector<std::int32_t> numbers = renumbered(surface, result.nodes);
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        std::array<std::int32_t, 6> nodes{};
        for (std::size_t i = 0; i < 3; ++i) {
            nodes[i] = numbers[at(surface.corners[t][i])];
            nodes[i + 3] = numbers[at(surface.edge_nodes[t][i])];
        }
        result.panels.push_back(make_panel(nodes, result.nodes));
        require_regular(result.panels.back(), t);
        mark_bent(result.panels.back());
    }
    // In the order of their nodes, so that panels which lie together are worked on together.
    std::sort(result.panels.begin(), result.panels.end(),
              [](const CurvedPanel& a, const CurvedPanel& b) { return a.nodes < b.nodes; });
    return result;
}

std::vector<double> interior_shares(const CurvedPanels& panels, int threads) {
    const std::size_t count = panels.nodes.size();
    std::vector<Vector3d> inwards(count, Vector3d::Zero());
    for (const CurvedPanel& panel : panels.panels) {
        for (std::size_t a = 0; a < 6; ++a) {
            const auto& [p, q] = node_coordinates[a];
            inwards[at(panel.nodes[a])] -= panel.area_normal(p, q).normalized();
        }
    }
    std::vector<std::array<double, 6>> angles(panels.panels.size());
    parallel_for(angles.size(), 64, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t j = begin; j < end; ++j) {
            for (std::size_t a = 0; a < 6; ++a) {
                const CurvedPanel& panel = panels.panels[j];
                angles[j][a] = sector_angle(panel, a, inwards[at(panel.nodes[a])].normalized());
            }
        }
    });
    std::vector<double> shares(count, 0.0);
    for (std::size_t j = 0; j < angles.size(); ++j) {
        for (std::size_t a = 0; a < 6; ++a) {
            shares[at(panels.panels[j].nodes[a])] -= angles[j][a] / (4.0 * std::numbers::pi);
        }
    }
    for (double& share : shares) share -= std::floor(share);  // the whole sphere cannot lie inside
    return shares;
}

}  // namespace samara
