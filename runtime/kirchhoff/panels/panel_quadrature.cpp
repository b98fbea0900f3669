#include "samara/kirchhoff/panels/panel_quadrature.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "samara/core/base/parallel_for.hpp"

namespace samara {
namespace {

using Corners = std::array<std::array<double, 2>, 3>;  // of a piece of the unit triangle
using Places = std::array<Vector3d, 3>;                // of its corners

constexpr int far_degree = 4;
constexpr std::array whole_panel_degrees = {6, 8};
constexpr std::array piece_degrees = {6, 8, 10, 14};
// Two cuts halve a piece: enough for distances down to 1e-9 of the panel.
constexpr int most_cuts = 60;
// The side across the rays is at most this many times as long as the shorter of the two rays at its ends.
constexpr double widest_fan = 1.3;
// On bent panels rules converge as if the panel were this many times as large.
constexpr double bent_radius = 2.0;
constexpr std::size_t panels_a_piece = 64;

/// Returns the square of the ratio from which a rule of a degree is enough.
double squared_ratio_for(int degree, double tolerance) {
    constexpr double measured_factor = 0.3;
    constexpr double least_ratio = 1.3;
    const double ratio = std::pow(measured_factor / tolerance, 1.0 / (degree + 1));
    return std::max(least_ratio * least_ratio, ratio * ratio);
}

/// Returns the first of the steps, which has the fewest points, that is enough at a ratio; else the last.
template <typename Steps>
const auto& enough_at(const Steps& steps, double squared_ratio) {
    const auto step = std::find_if(steps.begin(), steps.end(),
                                   [&](const auto& each) { return squared_ratio >= each.squared_ratio; });
    return step == steps.end() ? steps.back() : *step;
}

template <typename Real>
SourcePoints<Real> sources_of(const std::vector<CurvedPanel>& panels, const TriangleRule& rule, int threads) {
    SourcePoints<Real> result;
    result.points = rule.points;
    for (std::size_t i = 0; i < rule.points; ++i) {
        const std::array<double, 6> values = node_functions(rule.p[i], rule.q[i]);
        result.functions.emplace_back();
        std::transform(values.begin(), values.end(), result.functions.back().begin(),
                       [](double value) { return static_cast<Real>(value); });
    }
    result.sources.resize(panels.size() * rule.points);
    parallel_for(panels.size(), panels_a_piece, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t j = begin; j < end; ++j) {
            for (std::size_t i = 0; i < rule.points; ++i) {
                const Vector3d place = panels[j].place(rule.p[i], rule.q[i]);
                const Vector3d normal =
                    rule.weight[i] / (4.0 * std::numbers::pi) * panels[j].area_normal(rule.p[i], rule.q[i]);
                const Vector3d moment = place.cross(normal);
                SourcePoint<Real>& source = result.sources[j * rule.points + i];
                for (std::size_t k = 0; k < 3; ++k) {
                    const auto row = static_cast<Eigen::Index>(k);
                    source.place[k] = static_cast<Real>(place[row]);
                    source.normal[k] = static_cast<Real>(normal[row]);
                    source.moment[k] = static_cast<Real>(moment[row]);
                }
            }
        }
    });
    return result;
}

PanelPiece piece_between(const Corners& corners) {
    const auto& [a, b, c] = corners;
    return {a, {b[0] - a[0], b[1] - a[1]}, {c[0] - a[0], c[1] - a[1]}};
}

std::array<double, 2> between(const std::array<double, 2>& a, const std::array<double, 2>& b) {
    return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
}

Places places_of(const CurvedPanel& panel, const Corners& corners) {
    Places places;
    for (std::size_t i = 0; i < 3; ++i) places[i] = panel.place(corners[i][0], corners[i][1]);
    return places;
}

/// Returns whether the area normal changes little from the first corner of a piece to the others.
bool is_flat(const CurvedPanel& panel, const Corners& corners) {
    constexpr double most_normal_change = 0.7;  // of its length
    const Vector3d first = panel.area_normal(corners[0][0], corners[0][1]);
    return std::all_of(corners.begin() + 1, corners.end(), [&](const std::array<double, 2>& corner) {
        return (panel.area_normal(corner[0], corner[1]) - first).norm() < most_normal_change * first.norm();
    });
}

/// Converts sums with 1, p, q, p^2, pq, q^2 to sums with the node functions.
PanelIntegrals integrals_of(const PolynomialSums& sums) {
    std::array<double, 9> total{};
    for (std::size_t k = 0; k < 9; ++k) {
        for (const double lane : sums.lanes[k]) total[k] += lane;
    }
    const auto& [one, p, q, pp, pq, qq, x, y, z] = total;
    return {{one - 3.0 * (p + q) + 2.0 * (pp + qq) + 4.0 * pq, 2.0 * pp - p, 2.0 * qq - q,
             4.0 * (p - pp - pq), 4.0 * pq, 4.0 * (q - pq - qq)},
            {x, y, z}};
}

}  // namespace

PanelQuadrature::PanelQuadrature(const std::vector<CurvedPanel>& panels, double tolerance, int threads)
    : far_ratio_(std::sqrt(squared_ratio_for(far_degree, tolerance))),
      far_(sources_of<float>(panels, triangle_rule(far_degree), threads)) {
    for (const int degree : whole_panel_degrees) {
        const TriangleRule rule = triangle_rule(degree);
        whole_.push_back({squared_ratio_for(degree, tolerance), sources_of<double>(panels, rule, threads)});
    }
    for (const int degree : piece_degrees) {
        pieces_.push_back({squared_ratio_for(degree, tolerance), triangle_rule(degree)});
    }
    // A fan that is as wide as the rays are long converges by this factor a point across.
    constexpr double gain_a_point = 4.8;
    const int across = static_cast<int>(std::ceil(std::log(100.0 / tolerance) / std::log(gain_a_point)));
    rays_ = corner_rule(4, std::clamp(across, 4, 16));
}

double PanelQuadrature::effective_radius(const CurvedPanel& panel) {
    return panel.bent ? bent_radius * panel.radius : panel.radius;
}

const SourcePoints<double>& PanelQuadrature::near_sources(double squared_ratio) const {
    return enough_at(whole_, squared_ratio).rule;
}

PanelIntegrals PanelQuadrature::near_integrals(const CurvedPanel& panel, const Vector3d& node) const {
    PolynomialSums sums{};
    const Corners corners = {{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}};
    add_near(panel, corners, places_of(panel, corners), node, 0, sums);
    return integrals_of(sums);
}

void PanelQuadrature::add_near(const CurvedPanel& panel, const Corners& corners, const Places& places,
                               const Vector3d& node, int depth, PolynomialSums& sums) const {
    const Vector3d centre = panel.place((corners[0][0] + corners[1][0] + corners[2][0]) / 3.0,
                                        (corners[0][1] + corners[1][1] + corners[2][1]) / 3.0);
    double squared_radius = 0.0;
    for (const Vector3d& place : places) {
        squared_radius = std::max(squared_radius, (place - centre).squaredNorm());
    }
    const double squared_distance = (node - centre).squaredNorm();
    if (panel.bent && !is_flat(panel, corners)) squared_radius *= bent_radius * bent_radius;
    if (squared_distance >= pieces_.back().squared_ratio * squared_radius || depth == most_cuts) {
        const TriangleRule& rule = enough_at(pieces_, squared_distance / squared_radius).rule;
        add_piece(rule, piece_between(corners), panel, node, sums);
        return;
    }
    std::size_t longest = 0;
    double longest_square = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double square = (places[(i + 1) % 3] - places[i]).squaredNorm();
        if (square > longest_square) {
            longest_square = square;
            longest = i;
        }
    }
    const std::size_t next = (longest + 1) % 3;
    const std::array<double, 2> middle = between(corners[longest], corners[next]);
    const Vector3d middle_place = panel.place(middle[0], middle[1]);
    for (const std::size_t replaced : {longest, next}) {
        Corners half = corners;
        Places half_places = places;
        half[replaced] = middle;
        half_places[replaced] = middle_place;
        add_near(panel, half, half_places, node, depth + 1, sums);
    }
}

PanelIntegrals PanelQuadrature::own_integrals(const CurvedPanel& panel, std::size_t own) const {
    PolynomialSums sums{};
    const auto fan = [&](std::size_t from, std::size_t to) {
        const Corners corners = {node_coordinates[own], node_coordinates[from], node_coordinates[to]};
        add_rays(panel, corners, places_of(panel, corners), 0, sums);
    };
    if (own < 3) {
        fan((own + 1) % 3, (own + 2) % 3);
    } else {
        // The middle of the edge from corner own - 3 to the next one.
        const std::size_t first = own - 3;
        const std::size_t opposite = (first + 2) % 3;
        fan((first + 1) % 3, opposite);
        fan(opposite, first);
    }
    return integrals_of(sums);
}

void PanelQuadrature::add_rays(const CurvedPanel& panel, const Corners& corners, const Places& places,
                               int depth, PolynomialSums& sums) const {
    const auto& [node, first, last] = corners;
    const auto& [node_place, first_place, last_place] = places;
    const double shorter = std::min((first_place - node_place).norm(), (last_place - node_place).norm());
    if ((last_place - first_place).norm() > widest_fan * shorter && depth < most_cuts) {
        const std::array<double, 2> middle = between(first, last);
        const Vector3d middle_place = panel.place(middle[0], middle[1]);
        add_rays(panel, {node, first, middle}, {node_place, first_place, middle_place}, depth + 1, sums);
        add_rays(panel, {node, middle, last}, {node_place, middle_place, last_place}, depth + 1, sums);
        return;
    }
    if (!panel.bent || depth == most_cuts || is_flat(panel, corners)) {
        add_piece(rays_, piece_between(corners), panel, node_place, sums);
        return;
    }
    // The part of the fan beyond half the rays may come back near to the node.
    const Corners inner = {node, between(node, first), between(node, last)};
    add_rays(panel, inner, places_of(panel, inner), depth + 1, sums);
    for (const Corners& outer : {Corners{inner[1], first, last}, Corners{inner[1], last, inner[2]}}) {
        add_near(panel, outer, places_of(panel, outer), node_place, depth, sums);
    }
}

}  // namespace samara
