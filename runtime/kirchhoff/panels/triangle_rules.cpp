#include "samara/kirchhoff/panels/triangle_rules.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace samara {
namespace {

constexpr std::size_t register_lanes = 8;

/// Adds a point by its areal coordinates and its share of the triangle's area.
void add_point(TriangleRule& rule, double p, double q, double share) {
    rule.p.push_back(p);
    rule.q.push_back(q);
    rule.weight.push_back(0.5 * share);
}

/// Adds the three points with two equal areal coordinates `a`.
void add_three(TriangleRule& rule, double a, double share) {
    const double b = 1.0 - 2.0 * a;
    add_point(rule, a, a, share);
    add_point(rule, a, b, share);
    add_point(rule, b, a, share);
}

/// Adds the six points with the areal coordinates a, b and 1 - a - b.
void add_six(TriangleRule& rule, double a, double b, double share) {
    const double c = 1.0 - a - b;
    for (const auto& [p, q] : {std::pair{a, b}, {b, a}, {a, c}, {c, a}, {b, c}, {c, b}}) {
        add_point(rule, p, q, share);
    }
}

TriangleRule filled(TriangleRule rule, int degree) {
    rule.degree = degree;
    rule.points = rule.weight.size();
    while (rule.weight.size() % register_lanes != 0) add_point(rule, 1.0 / 3.0, 1.0 / 3.0, 0.0);
    return rule;
}

}  // namespace

std::pair<std::vector<double>, std::vector<double>> gauss_legendre(int n) {
    std::vector<double> nodes;
    std::vector<double> weights;
    for (int i = 0; i < n; ++i) {
        // Newton's method on the Legendre polynomial, from the usual asymptotic guess.
        double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5));
        double slope = 1.0;
        for (int iteration = 0; iteration < 100; ++iteration) {
            double previous = 1.0;
            double value = x;
            for (int k = 2; k <= n; ++k) {
                const double next = ((2 * k - 1) * x * value - (k - 1) * previous) / k;
                previous = value;
                value = next;
            }
            slope = n * (x * value - previous) / (x * x - 1.0);
            const double step = value / slope;
            x -= step;
            if (std::abs(step) < 1e-15) break;
        }
        nodes.push_back(0.5 * (1.0 - x));
        weights.push_back(1.0 / ((1.0 - x * x) * slope * slope));
    }
    return {nodes, weights};
}

TriangleRule triangle_rule(int degree) {
    TriangleRule rule;
    if (degree == 2) {
        add_three(rule, 1.0 / 6.0, 1.0 / 3.0);
    } else if (degree == 4) {
        add_three(rule, 0.445948490915964886, 0.223381589678011466);
        add_three(rule, 0.091576213509770743, 0.109951743655321868);
    } else if (degree == 6) {
        add_three(rule, 0.249286745170910421, 0.116786275726379366);
        add_three(rule, 0.063089014491502228, 0.050844906370206817);
        add_six(rule, 0.053145049844816947, 0.310352451033784405, 0.082851075618373575);
    } else if (degree == 8) {
        add_point(rule, 1.0 / 3.0, 1.0 / 3.0, 0.144315607677787168);
        add_three(rule, 0.459292588292723156, 0.095091634267284625);
        add_three(rule, 0.170569307751760207, 0.103217370534718250);
        add_three(rule, 0.050547228317030975, 0.032458497623198080);
        add_six(rule, 0.263112829634638113, 0.008394777409957605, 0.027230314174434994);
    } else {
        // The collapse onto the corner adds one degree along the rays.
        const TriangleRule collapsed = corner_rule((degree + 3) / 2, degree / 2 + 1);
        for (std::size_t i = 0; i < collapsed.points; ++i) {
            add_point(rule, collapsed.p[i], collapsed.q[i], 2.0 * collapsed.weight[i]);
        }
    }
    return filled(std::move(rule), degree);
}

TriangleRule corner_rule(int radial_points, int angular_points) {
    const auto [radii, radial_weights] = gauss_legendre(radial_points);
    const auto [angles, angular_weights] = gauss_legendre(angular_points);
    TriangleRule rule;
    for (std::size_t i = 0; i < radii.size(); ++i) {
        for (std::size_t j = 0; j < angles.size(); ++j) {
            add_point(rule, radii[i] * (1.0 - angles[j]), radii[i] * angles[j],
                      2.0 * radial_weights[i] * radii[i] * angular_weights[j]);
        }
    }
    return filled(std::move(rule), std::min(2 * radial_points - 2, 2 * angular_points - 1));
}

namespace {

std::vector<RulePoint> barycentric(const TriangleRule& rule) {
    std::vector<RulePoint> points;
    for (std::size_t i = 0; i < rule.points; ++i) {
        points.push_back({{1.0 - rule.p[i] - rule.q[i], rule.p[i], rule.q[i]}, 2.0 * rule.weight[i]});
    }
    return points;
}

}  // namespace

const std::vector<RulePoint>& symmetric_rule(int degree) {
    static const std::array<std::vector<RulePoint>, 4> rules = {
        barycentric(triangle_rule(2)), barycentric(triangle_rule(4)), barycentric(triangle_rule(6)),
        barycentric(triangle_rule(8))};
    return rules[static_cast<std::size_t>(degree / 2 - 1)];
}

}  // namespace samara
