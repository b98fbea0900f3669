#include "samara/kirchhoff/panels/curved_collocation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/parallel_for.hpp"
#include "samara/kirchhoff/operators/curved_equations.hpp"
#include "samara/kirchhoff/panels/triangle_rules.hpp"
#include "samara/kirchhoff/solvers/near_field_inverse.hpp"

namespace samara {
namespace {

constexpr int most_iterations = 100;
constexpr int iterations_without_inverse = 8;
constexpr std::size_t panels_a_piece = 64;
constexpr double open_surface = 0.02;  // closure error

Eigen::Index row_of(std::size_t index) {
    return static_cast<Eigen::Index>(index);
}

/// -integral of f_a N for the node function of every node, N = (x cross n, n).
SixColumns normal_moments(const CurvedPanels& panels, int threads) {
    const TriangleRule rule = triangle_rule(6);  // of the polynomials' own degree
    std::vector<Matrix6d> parts(panels.panels.size());
    parallel_for(parts.size(), panels_a_piece, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t j = begin; j < end; ++j) {
            parts[j].setZero();
            for (std::size_t i = 0; i < rule.points; ++i) {
                const CurvedPanel& panel = panels.panels[j];
                const Vector3d normal = rule.weight[i] * panel.area_normal(rule.p[i], rule.q[i]);
                Vector6d both;
                both << panel.place(rule.p[i], rule.q[i]).cross(normal), normal;
                const std::array<double, 6> functions = node_functions(rule.p[i], rule.q[i]);
                parts[j].noalias() -= both * Eigen::Map<const Vector6d>(functions.data()).transpose();
            }
        }
    });
    SixColumns moments = SixColumns::Zero(row_of(panels.nodes.size()), 6);
    for (std::size_t j = 0; j < parts.size(); ++j) {
        for (std::size_t a = 0; a < 6; ++a) {
            moments.row(panels.panels[j].nodes[a]) += parts[j].col(row_of(a)).transpose();
        }
    }
    return moments;
}

/// The mean thickness, twice the volume over the surface, in mean sizes of the panels; at most 1.
double thickness_in_panels(const CurvedPanels& panels, const SixColumns& moments) {
    double volume = 0.0;
    for (std::size_t i = 0; i < panels.nodes.size(); ++i) {
        volume -= moments.row(row_of(i)).tail<3>().dot(panels.nodes[i]) / 3.0;
    }
    double area = 0.0;
    for (const CurvedPanel& panel : panels.panels)
        area += 0.5 * panel.area_normal(1.0 / 3.0, 1.0 / 3.0).norm();
    const double size = std::sqrt(area / static_cast<double>(panels.panels.size()));
    return std::clamp(2.0 * volume / (area * size), 1e-6, 1.0);
}

/// The accuracy of the integrals that keeps their part of the tensor's error below a tenth of the elements'
/// own, as measured on ellipsoids. Across a thin body the two sides cancel, and more is needed.
double quadrature_tolerance(const CurvedPanels& panels, double thickness) {
    const double smooth = std::clamp(10.0 / static_cast<double>(panels.panels.size()), 1e-4, 0.03);
    return std::max(1e-8, smooth * thickness * thickness);
}

/// Of the residual: a hundredth of the error that curved panels leave on ellipsoids, at most.
double solver_tolerance(const CurvedPanels& panels) {
    const auto count = static_cast<double>(panels.panels.size());
    return std::clamp(1.0 / (count * count), 1e-9, 1e-5);
}

/// Without a preconditioner where that converges soon, as it does on all but thin bodies. The thinner the
/// body, the more entries count: what is left out of the inverse must be small against its least modes.
BlockSolution solve(const CurvedPanels& panels, const CurvedEquations& equations, double thickness,
                    int threads) {
    const auto times_matrix = [&](const SixColumns& columns) { return equations.multiply(columns, threads); };
    std::optional<NearFieldInverse> near_field;
    const auto precondition = [&](const SixColumns& residuals, int iterations) -> SixColumns {
        if (iterations < iterations_without_inverse) return residuals;
        if (!near_field) near_field.emplace(equations, std::min(0.01, 0.1 * thickness));
        return *near_field * residuals;
    };
    BlockSolution solution = solve_block(times_matrix, equations.right_hand_sides,
                                         {solver_tolerance(panels), most_iterations, precondition});
    // What is not closed need not have a solution; its closure error says so.
    if (!solution.converged && equations.closure_error < open_surface) {
        throw Error(
            fmt::format("the equations of {} curved triangles did not converge in {} steps; mesh the "
                        "shape again with 'samara mesh', with more or more even triangles",
                        panels.panels.size(), most_iterations));
    }
    return solution;
}

}  // namespace

BoundaryElementResult solve_curved_collocation(const Surface& surface,
                                               const BoundaryElementOptions& options) {
    const CurvedPanels panels = make_curved_panels(surface);
    const SixColumns moments = normal_moments(panels, options.threads);
    const double thickness = thickness_in_panels(panels, moments);
    const CurvedEquations equations =
        assemble_curved_equations(panels, quadrature_tolerance(panels, thickness), options);
    BoundaryElementResult result;
    result.unknowns = equations.count;
    result.memory = equations.rows.bytes();
    result.closure_error = equations.closure_error;
    BlockSolution solution = solve(panels, equations, thickness, options.threads);
    result.iterations = solution.iterations;
    for (std::size_t i = 0; i < equations.count; ++i) {
        solution.columns.row(row_of(i)).tail<3>() += panels.nodes[i].transpose();  // phi = psi + x
    }
    result.tensor = solution.columns.transpose() * moments;
    return result;
}

}  // namespace samara
