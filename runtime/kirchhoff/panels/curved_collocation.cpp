#include "samara/kirchhoff/panels/curved_collocation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/SparseLU>
#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/machine_memory.hpp"
#include "samara/core/base/parallel_for.hpp"
#include "samara/kirchhoff/operators/boundary_elements.hpp"
#include "samara/kirchhoff/panels/curved_panels.hpp"
#include "samara/kirchhoff/panels/panel_kernels.hpp"
#include "samara/kirchhoff/panels/panel_quadrature.hpp"
#include "samara/kirchhoff/panels/triangle_rules.hpp"
#include "samara/kirchhoff/solvers/block_solver.hpp"

namespace samara {
namespace {

/// The discrete equations A phi' = b of curved panels, one row for each node: A = 1/2 - D, in single
/// precision apart from the diagonal, which is such that each row sums to 1 in double precision.
struct CurvedEquations {
    std::size_t count = 0;        ///< nodes
    std::size_t groups = 0;       ///< groups of group_size nodes, the last filled up
    LargeArray<float> rows;       ///< A without its diagonal, group after group
    Eigen::VectorXd diagonal;     ///< diagonal of A
    SixColumns right_hand_sides;  ///< -S (x cross n) for omega, -x for v
    double closure_error = 0.0;   ///< BoundaryElementResult::closure_error

    /// Returns A times six columns.
    [[nodiscard]] SixColumns multiply(const SixColumns& columns, int threads) const;
    [[nodiscard]] const float* group_rows(std::size_t group) const;
    [[nodiscard]] float* group_rows(std::size_t group);
};

constexpr std::size_t groups_a_piece = 2;
// Nearer than this, the rounding of the places in single precision counts. The body's size is 1.
constexpr double least_far_distance = 0.02;

/// Fills the equations of one group of nodes after the other.
class GroupAssembly {
  public:
    GroupAssembly(const CurvedPanels& panels, const PanelQuadrature& quadrature,
                  const std::vector<double>& shares, CurvedEquations& equations, Eigen::VectorXd& row_errors)
        : panels_(panels),
          quadrature_(quadrature),
          shares_(shares),
          equations_(equations),
          row_errors_(row_errors) {}

    void assemble(std::size_t group) {
        first_ = group * group_size;
        last_ = std::min(first_ + group_size, equations_.count);
        rows_ = equations_.group_rows(group);
        potentials_ = {};
        place_group();
        add_panels();
        close_rows();
    }

  private:
    void place_group() {
        Eigen::AlignedBox3d box;
        for (std::size_t i = 0; i < group_size; ++i) {
            // A group that is not full is filled up with its last node.
            const Vector3d& node = panels_.nodes[std::min(first_ + i, last_ - 1)];
            box.extend(node);
            wide_.x[i] = node.x();
            wide_.y[i] = node.y();
            wide_.z[i] = node.z();
            narrow_.x[i] = static_cast<float>(node.x());
            narrow_.y[i] = static_cast<float>(node.y());
            narrow_.z[i] = static_cast<float>(node.z());
        }
        centre_ = box.center();
        radius_ = 0.5 * box.diagonal().norm();
    }

    void add_panels() {
        far_.clear();
        const double ratio = quadrature_.far_ratio();
        for (std::size_t j = 0; j < panels_.panels.size(); ++j) {
            const CurvedPanel& panel = panels_.panels[j];
            const double reach =
                std::max(ratio * PanelQuadrature::effective_radius(panel), least_far_distance) + radius_;
            if ((panel.centre - centre_).squaredNorm() >= reach * reach) {
                far_.push_back(static_cast<std::uint32_t>(j));
            } else {
                add_near(j);
            }
        }
        add_far_panels(quadrature_.far_sources(), panels_.panels, far_, narrow_, rows_, potentials_);
    }

    /// Integrates a panel by one rule at all nodes of the group, except at those that are very near.
    void add_near(std::size_t j) {
        const CurvedPanel& panel = panels_.panels[j];
        const double least = quadrature_.least_squared_ratio();
        const double radius = PanelQuadrature::effective_radius(panel);
        const double scale = 1.0 / (radius * radius);
        std::array<double, group_size> ratios;
        for (std::size_t i = 0; i < group_size; ++i) {
            const double x = wide_.x[i] - panel.centre.x();
            const double y = wide_.y[i] - panel.centre.y();
            const double z = wide_.z[i] - panel.centre.z();
            ratios[i] = (x * x + y * y + z * z) * scale;
        }
        double least_by_rule = HUGE_VAL;
        std::array<double, group_size> by_rule{};
        for (std::size_t i = 0; i < last_ - first_; ++i) {
            if (ratios[i] >= least) {
                by_rule[i] = 1.0;
                least_by_rule = std::min(least_by_rule, ratios[i]);
            } else {
                add_very_near(panel, i);
            }
        }
        if (least_by_rule == HUGE_VAL) return;
        add_near_panel(quadrature_.near_sources(least_by_rule), panels_.panels, j, wide_, by_rule, rows_,
                       potentials_);
    }

    void add_very_near(const CurvedPanel& panel, std::size_t i) {
        const auto own =
            std::find(panel.nodes.begin(), panel.nodes.end(), static_cast<std::int32_t>(first_ + i));
        const PanelIntegrals integrals =
            own == panel.nodes.end()
                ? quadrature_.near_integrals(panel, panels_.nodes[first_ + i])
                : quadrature_.own_integrals(panel, static_cast<std::size_t>(own - panel.nodes.begin()));
        for (std::size_t a = 0; a < 6; ++a) add_entry(panel.nodes[a], i, integrals.double_layer[a]);
        for (std::size_t k = 0; k < 3; ++k) potentials_[k][i] += integrals.potential[eigen_index(k)];
    }

    void add_entry(std::int32_t column, std::size_t i, double value) {
        rows_[static_cast<std::size_t>(column) * group_size + i] += static_cast<float>(value);
    }

    /// Sets the diagonal so that (1/2 - D) 1 = 1, which holds on every closed surface, whatever the angle at
    /// the node.
    void close_rows() {
        const std::array<double, group_size> sums = row_sums(rows_, equations_.count);
        for (std::size_t i = 0; i < last_ - first_; ++i) {
            const std::size_t row = first_ + i;
            float& own = rows_[row * group_size + i];
            equations_.diagonal[eigen_index(row)] = 1.0 - (sums[i] - static_cast<double>(own));
            row_errors_[eigen_index(row)] = std::abs(sums[i] - shares_[row]);
            own = 0.0F;
            equations_.right_hand_sides.row(eigen_index(row)) << -potentials_[0][i], -potentials_[1][i],
                -potentials_[2][i], -panels_.nodes[row].transpose();
        }
    }

    const CurvedPanels& panels_;
    const PanelQuadrature& quadrature_;
    const std::vector<double>& shares_;
    CurvedEquations& equations_;
    Eigen::VectorXd& row_errors_;
    std::size_t first_ = 0;
    std::size_t last_ = 0;
    float* rows_ = nullptr;
    GroupPotentials potentials_{};
    NodeGroup<double> wide_{};
    NodeGroup<float> narrow_{};
    Vector3d centre_;
    double radius_ = 0.0;
    std::vector<std::uint32_t> far_;
};

float* CurvedEquations::group_rows(std::size_t group) {
    return rows.data() + group * count * group_size;
}

const float* CurvedEquations::group_rows(std::size_t group) const {
    return rows.data() + group * count * group_size;
}

SixColumns CurvedEquations::multiply(const SixColumns& columns, int threads) const {
    SixColumns product(columns.rows(), 6);
    parallel_for(groups, groups_a_piece, threads, [&](std::size_t begin, std::size_t end) {
        std::array<double, group_size * 6> part;
        for (std::size_t group = begin; group < end; ++group) {
            multiply_group(group_rows(group), count, columns.data(), part.data());
            const std::size_t first = group * group_size;
            for (std::size_t row = first; row < std::min(first + group_size, count); ++row) {
                product.row(eigen_index(row)) =
                    Eigen::Map<const Eigen::Matrix<double, 1, 6>>(&part[(row - first) * 6]) +
                    diagonal[eigen_index(row)] * columns.row(eigen_index(row));
            }
        }
    });
    return product;
}

/// Assembles the equations with integrals of the relative accuracy `tolerance` (PanelQuadrature).
CurvedEquations assemble_curved_equations(const CurvedPanels& panels, double tolerance,
                                          const BoundaryElementOptions& options) {
    CurvedEquations equations;
    equations.count = panels.nodes.size();
    equations.groups = (equations.count + group_size - 1) / group_size;
    equations.rows = LargeArray<float>(equations.groups * group_size * equations.count);
    equations.diagonal.resize(eigen_index(equations.count));
    equations.right_hand_sides.resize(eigen_index(equations.count), 6);
    Eigen::VectorXd row_errors(eigen_index(equations.count));
    const PanelQuadrature quadrature(panels.panels, tolerance, options.threads);
    const std::vector<double> shares = interior_shares(panels, options.threads);
    parallel_for(
        equations.groups, groups_a_piece, options.threads,
        [&](std::size_t begin, std::size_t end) {
            GroupAssembly assembly(panels, quadrature, shares, equations, row_errors);
            for (std::size_t group = begin; group < end; ++group) assembly.assemble(group);
        },
        options.progress);
    equations.closure_error = row_errors.maxCoeff();
    return equations;
}

/// The inverse of the strong entries of the matrix alone, to precondition with: it takes up the pairs of
/// panels that face each other across a thin body, which a solver without it is slow on.
class NearFieldInverse {
  public:
    /// Factorises the diagonal and the entries above `least_entry`.
    NearFieldInverse(const CurvedEquations& equations, double least_entry);

    /// Returns the inverse times six columns; the columns themselves where the strong entries have no
    /// inverse.
    [[nodiscard]] SixColumns operator*(const SixColumns& columns) const;

  private:
    Eigen::SparseLU<Eigen::SparseMatrix<double>> factors_;
};

NearFieldInverse::NearFieldInverse(const CurvedEquations& equations, double least_entry) {
    const auto strong_entry = static_cast<float>(least_entry);
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t group = 0; group < equations.groups; ++group) {
        const float* rows = equations.group_rows(group);
        for (std::size_t entry = 0; entry < equations.count * group_size; ++entry) {
            if (!(std::abs(rows[entry]) > strong_entry)) continue;
            const std::size_t row = group * group_size + entry % group_size;
            if (row >= equations.count) continue;
            entries.emplace_back(static_cast<int>(row), static_cast<int>(entry / group_size),
                                 static_cast<double>(rows[entry]));
        }
    }
    const auto size = static_cast<int>(equations.count);
    for (int row = 0; row < size; ++row) entries.emplace_back(row, row, equations.diagonal[row]);
    Eigen::SparseMatrix<double> strong(size, size);
    strong.setFromTriplets(entries.begin(), entries.end());
    factors_.compute(strong);
}

SixColumns NearFieldInverse::operator*(const SixColumns& columns) const {
    if (factors_.info() != Eigen::Success) return columns;
    const Eigen::MatrixXd result = factors_.solve(Eigen::MatrixXd(columns));
    return result;
}

constexpr int most_solver_iterations = 100;
constexpr int iterations_without_inverse = 8;
constexpr std::size_t curved_panels_a_piece = 64;
constexpr double open_surface = 0.02;  // closure error

/// Returns -integral of f_a N for the node function of every node, N = (x cross n, n).
SixColumns normal_moments(const CurvedPanels& panels, int threads) {
    const TriangleRule rule = triangle_rule(6);  // of the polynomials' own degree
    std::vector<Matrix6d> parts(panels.panels.size());
    parallel_for(parts.size(), curved_panels_a_piece, threads, [&](std::size_t begin, std::size_t end) {
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
    SixColumns moments = SixColumns::Zero(eigen_index(panels.nodes.size()), 6);
    for (std::size_t j = 0; j < parts.size(); ++j) {
        for (std::size_t a = 0; a < 6; ++a) {
            moments.row(panels.panels[j].nodes[a]) += parts[j].col(eigen_index(a)).transpose();
        }
    }
    return moments;
}

/// Returns the mean thickness, twice the volume over the surface, in mean sizes of the panels; at most 1.
double thickness_in_panels(const CurvedPanels& panels, const SixColumns& moments) {
    double volume = 0.0;
    for (std::size_t i = 0; i < panels.nodes.size(); ++i) {
        volume -= moments.row(eigen_index(i)).tail<3>().dot(panels.nodes[i]) / 3.0;
    }
    double area = 0.0;
    for (const CurvedPanel& panel : panels.panels)
        area += 0.5 * panel.area_normal(1.0 / 3.0, 1.0 / 3.0).norm();
    const double size = std::sqrt(area / static_cast<double>(panels.panels.size()));
    return std::clamp(2.0 * volume / (area * size), 1e-6, 1.0);
}

/// Returns the accuracy of the integrals that keeps their part of the tensor's error below a tenth of the
/// elements' own, as measured on ellipsoids. Across a thin body the two sides cancel, and more is needed.
double quadrature_tolerance(const CurvedPanels& panels, double thickness) {
    const double smooth = std::clamp(10.0 / static_cast<double>(panels.panels.size()), 1e-4, 0.03);
    return std::max(1e-8, smooth * thickness * thickness);
}

/// Returns the relative residual to solve to: at most a hundredth of the error that curved panels leave on
/// ellipsoids.
double solver_tolerance(const CurvedPanels& panels) {
    const auto count = static_cast<double>(panels.panels.size());
    return std::clamp(1.0 / (count * count), 1e-9, 1e-5);
}

/// Solves the equations, without a preconditioner where that converges soon, as it does on all but thin
/// bodies. The thinner the body, the more entries count: what is left out of the inverse must be small
/// against its least modes.
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
                                         {solver_tolerance(panels), most_solver_iterations, precondition});
    // The equations of an open surface need not have a solution; its closure error says so.
    if (!solution.converged && equations.closure_error < open_surface) {
        throw Error(
            fmt::format("the equations of {} curved triangles did not converge in {} steps; mesh the shape "
                        "again with 'samara mesh', with more or more regular triangles",
                        panels.panels.size(), most_solver_iterations));
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
        solution.columns.row(eigen_index(i)).tail<3>() += panels.nodes[i].transpose();  // phi = psi + x
    }
    result.tensor = solution.columns.transpose() * moments;
    return result;
}

}  // namespace samara
