#include "samara/kirchhoff/curved_collocation.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include <Eigen/LU>
#include <Eigen/SparseLU>
#include <hwy/aligned_allocator.h>

#include "samara/base/parallel_for.hpp"
#include "samara/kirchhoff/block_solver.hpp"
#include "samara/kirchhoff/panel_quadrature.hpp"

namespace samara {
namespace {

constexpr std::size_t groups_a_piece = 2;

Eigen::Index row_of(std::size_t index) {
    return static_cast<Eigen::Index>(index);
}

/// The equations A phi' = b: six columns in the order (omega, v). The rows of A in groups, without the
/// diagonal.
struct Equations {
    std::size_t count = 0;
    std::size_t groups = 0;
    hwy::AlignedFreeUniquePtr<float[]> rows;  // group after group
    Eigen::VectorXd diagonal;
    SixColumns right_hand_sides;  // -S (x cross n) for omega, -x for v
    Eigen::VectorXd row_faults;

    [[nodiscard]] float* group_rows(std::size_t group) const {
        return rows.get() + group * count * group_size;
    }
    [[nodiscard]] std::size_t bytes() const { return groups * group_size * count * sizeof(float); }
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
        std::memset(rows_, 0, equations_.count * group_size * sizeof(float));
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
                add_near_panel(j);
            }
        }
        add_far_panels(quadrature_.far_sources(), panels_.panels, far_, narrow_, rows_, potentials_);
    }

    /// By one rule at all nodes of the group, except at those that are very near.
    void add_near_panel(std::size_t j) {
        const CurvedPanel& panel = panels_.panels[j];
        double least_ratio = HUGE_VAL;
        std::array<bool, group_size> by_rule{};
        for (std::size_t i = 0; i < last_ - first_; ++i) {
            const double ratio = (panels_.nodes[first_ + i] - panel.centre).norm() / panel.radius;
            by_rule[i] = quadrature_.near_sources(ratio) != nullptr;
            if (by_rule[i]) {
                least_ratio = std::min(least_ratio, ratio);
            } else {
                add_very_near(panel, i);
            }
        }
        if (least_ratio == HUGE_VAL) return;
        PanelSums sums;
        sum_panel(*quadrature_.near_sources(least_ratio), j, wide_, sums);
        for (std::size_t i = 0; i < group_size; ++i) {
            if (!by_rule[i]) continue;
            for (std::size_t a = 0; a < 6; ++a) add_entry(panel.nodes[a], i, sums.values[a][i]);
            for (std::size_t k = 0; k < 3; ++k) potentials_[k][i] += sums.values[6 + k][i];
        }
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
        const std::array<double, group_size> with_own = row_sums(rows_, equations_.count);
        for (std::size_t i = 0; i < last_ - first_; ++i) rows_[(first_ + i) * group_size + i] = 0.0F;
        const std::array<double, group_size> sums = row_sums(rows_, equations_.count);
        for (std::size_t i = 0; i < last_ - first_; ++i) {
            const std::size_t row = first_ + i;
            equations_.diagonal[row_of(row)] = 1.0 - sums[i];
            equations_.row_faults[row_of(row)] = std::abs(with_own[i] - shares_[row]);
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
    std::array<std::array<double, group_size>, 3> potentials_{};
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
    equations.rows = hwy::AllocateAligned<float>(equations.groups * group_size * equations.count);
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
SixColumns normal_moments(const CurvedPanels& panels) {
    const TriangleRule rule = triangle_rule(6);  // of the polynomials' own degree
    SixColumns moments = SixColumns::Zero(row_of(panels.nodes.size()), 6);
    for (const CurvedPanel& panel : panels.panels) {
        for (std::size_t i = 0; i < rule.points; ++i) {
            const Vector3d normal = rule.weight[i] * panel.area_normal(rule.p[i], rule.q[i]);
            Vector6d both;
            both << panel.place(rule.p[i], rule.q[i]).cross(normal), normal;
            const std::array<double, 6> functions = node_functions(rule.p[i], rule.q[i]);
            for (std::size_t a = 0; a < 6; ++a) {
                moments.row(panel.nodes[a]) -= functions[a] * both.transpose();
            }
        }
    }
    return moments;
}

}  // namespace

BoundaryElementResult solve_curved_collocation(const Surface& surface,
                                               const BoundaryElementOptions& options) {
    const CurvedPanels panels = make_curved_panels(surface);
    const auto triangles = static_cast<double>(panels.panels.size());
    const double tolerance = std::clamp(4.0 / (triangles * triangles), 1e-8, 1e-4);
    const Equations equations = assemble(panels, tolerance, options);
    BoundaryElementResult result;
    result.unknowns = equations.count;
    result.memory = equations.bytes();
    result.closure_fault = equations.row_faults.maxCoeff();
    const auto times_matrix = [&](const SixColumns& columns) {
        return multiply(equations, columns, options.threads);
    };
    const SixColumns start = SixColumns::Zero(row_of(equations.count), 6);
    BlockSolution solution =
        solve_block(times_matrix, equations.right_hand_sides, start, {0.1 * tolerance, 100, {}});
    result.iterations = solution.iterations;
    for (std::size_t i = 0; i < equations.count; ++i) {
        solution.columns.row(row_of(i)).tail<3>() += panels.nodes[i].transpose();  // phi = psi + x
    }
    result.tensor = solution.columns.transpose() * normal_moments(panels);
    return result;
}

}  // namespace samara
