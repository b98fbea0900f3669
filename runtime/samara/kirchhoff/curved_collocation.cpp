#include "samara/kirchhoff/curved_collocation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/LU>
#include <Eigen/SparseLU>

#include "samara/base/large_array.hpp"
#include "samara/base/parallel_for.hpp"
#include "samara/kirchhoff/block_solver.hpp"
#include "samara/kirchhoff/panel_quadrature.hpp"

namespace samara {
namespace {

constexpr int most_iterations = 200;
constexpr std::size_t groups_a_piece = 2;
constexpr std::size_t panels_a_piece = 64;

Eigen::Index row_of(std::size_t index) {
    return static_cast<Eigen::Index>(index);
}

/// The equations A phi' = b: six columns in the order (omega, v). The rows of A in groups, without the
/// diagonal.
struct Equations {
    std::size_t count = 0;
    std::size_t groups = 0;
    LargeArray<float> rows;  // group after group
    Eigen::VectorXd diagonal;
    SixColumns right_hand_sides;  // -S (x cross n) for omega, -x for v
    Eigen::VectorXd row_faults;

    [[nodiscard]] float* group_rows(std::size_t group) const {
        return rows.data() + group * count * group_size;
    }
};

/// Fills the equations of one group of nodes after the other.
class GroupAssembly {
  public:
    GroupAssembly(const CurvedPanels& panels, const PanelQuadrature& quadrature,
                  const std::vector<double>& shares, Equations& equations)
        : panels_(panels), quadrature_(quadrature), shares_(shares), equations_(equations) {}

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
            const double reach = ratio * panel.radius + radius_;
            if ((panel.centre - centre_).squaredNorm() >= reach * reach) {
                far_.push_back(static_cast<std::uint32_t>(j));
            } else {
                add_near(j);
            }
        }
        add_far_panels(quadrature_.far_sources(), panels_.panels, far_, narrow_, rows_, potentials_);
    }

    /// By one rule at all nodes of the group, except at those that are very near.
    void add_near(std::size_t j) {
        const CurvedPanel& panel = panels_.panels[j];
        const double least = quadrature_.least_squared_ratio();
        const double scale = 1.0 / (panel.radius * panel.radius);
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
        for (std::size_t k = 0; k < 3; ++k) potentials_[k][i] += integrals.potential[row_of(k)];
    }

    void add_entry(std::int32_t column, std::size_t i, double value) {
        rows_[static_cast<std::size_t>(column) * group_size + i] += static_cast<float>(value);
    }

    /// (1/2 - D) 1 = 1 holds on every closed surface: it sets the diagonal, whatever the angle at the node.
    void close_rows() {
        const std::array<double, group_size> sums = row_sums(rows_, equations_.count);
        for (std::size_t i = 0; i < last_ - first_; ++i) {
            const std::size_t row = first_ + i;
            float& own = rows_[row * group_size + i];
            equations_.diagonal[row_of(row)] = 1.0 - (sums[i] - static_cast<double>(own));
            equations_.row_faults[row_of(row)] = std::abs(sums[i] - shares_[row]);
            own = 0.0F;
            equations_.right_hand_sides.row(row_of(row)) << -potentials_[0][i], -potentials_[1][i],
                -potentials_[2][i], -panels_.nodes[row].transpose();
        }
    }

    const CurvedPanels& panels_;
    const PanelQuadrature& quadrature_;
    const std::vector<double>& shares_;
    Equations& equations_;
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

Equations assemble(const CurvedPanels& panels, double tolerance, const BoundaryElementOptions& options) {
    Equations equations;
    equations.count = panels.nodes.size();
    equations.groups = (equations.count + group_size - 1) / group_size;
    equations.rows = LargeArray<float>(equations.groups * group_size * equations.count);
    equations.diagonal.resize(row_of(equations.count));
    equations.right_hand_sides.resize(row_of(equations.count), 6);
    equations.row_faults.resize(row_of(equations.count));
    const PanelQuadrature quadrature(panels.panels, tolerance, options.threads);
    const std::vector<double> shares = interior_shares(panels);
    parallel_for(
        equations.groups, groups_a_piece, options.threads,
        [&](std::size_t begin, std::size_t end) {
            GroupAssembly assembly(panels, quadrature, shares, equations);
            for (std::size_t group = begin; group < end; ++group) assembly.assemble(group);
        },
        options.progress);
    return equations;
}

SixColumns multiply(const Equations& equations, const SixColumns& columns, int threads) {
    SixColumns product(columns.rows(), 6);
    parallel_for(equations.groups, groups_a_piece, threads, [&](std::size_t begin, std::size_t end) {
        std::array<double, group_size * 6> part;
        for (std::size_t group = begin; group < end; ++group) {
            multiply_group(equations.group_rows(group), equations.count, columns.data(), part.data());
            const std::size_t first = group * group_size;
            for (std::size_t row = first; row < std::min(first + group_size, equations.count); ++row) {
                product.row(row_of(row)) =
                    Eigen::Map<const Eigen::Matrix<double, 1, 6>>(&part[(row - first) * 6]) +
                    equations.diagonal[row_of(row)] * columns.row(row_of(row));
            }
        }
    });
    return product;
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
double quadrature_tolerance(const CurvedPanels& panels, const SixColumns& moments) {
    const double smooth = std::clamp(10.0 / static_cast<double>(panels.panels.size()), 1e-4, 0.03);
    const double thickness = thickness_in_panels(panels, moments);
    return std::max(1e-8, smooth * thickness * thickness);
}

/// Of the residual: a hundredth of the error that curved panels leave on ellipsoids, at most.
double solver_tolerance(const CurvedPanels& panels) {
    const auto count = static_cast<double>(panels.panels.size());
    return std::clamp(1.0 / (count * count), 1e-9, 1e-5);
}

}  // namespace

BoundaryElementResult solve_curved_collocation(const Surface& surface,
                                               const BoundaryElementOptions& options) {
    const CurvedPanels panels = make_curved_panels(surface);
    const SixColumns moments = normal_moments(panels, options.threads);
    const double tolerance = quadrature_tolerance(panels, moments);
    const Equations equations = assemble(panels, tolerance, options);
    BoundaryElementResult result;
    result.unknowns = equations.count;
    result.memory = equations.rows.bytes();
    result.closure_fault = equations.row_faults.maxCoeff();
    const auto times_matrix = [&](const SixColumns& columns) {
        return multiply(equations, columns, options.threads);
    };
    const SixColumns start = SixColumns::Zero(row_of(equations.count), 6);
    BlockSolution solution = solve_block(times_matrix, equations.right_hand_sides, start,
                                         {solver_tolerance(panels), most_iterations, {}});
    result.iterations = solution.iterations;
    for (std::size_t i = 0; i < equations.count; ++i) {
        solution.columns.row(row_of(i)).tail<3>() += panels.nodes[i].transpose();  // phi = psi + x
    }
    result.tensor = solution.columns.transpose() * moments;
    return result;
}

}  // namespace samara
