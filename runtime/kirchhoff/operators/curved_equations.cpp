#include "samara/kirchhoff/operators/curved_equations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "samara/core/base/parallel_for.hpp"
#include "samara/kirchhoff/panels/panel_quadrature.hpp"

namespace samara {
namespace {

constexpr std::size_t groups_a_piece = 2;
// Nearer than this, the rounding of the places in single precision counts. The body's size is 1.
constexpr double least_far_distance = 0.02;

Eigen::Index row_of(std::size_t index) {
    return static_cast<Eigen::Index>(index);
}

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

    /// By one rule at all nodes of the group, except at those that are very near.
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
            row_errors_[row_of(row)] = std::abs(sums[i] - shares_[row]);
            own = 0.0F;
            equations_.right_hand_sides.row(row_of(row)) << -potentials_[0][i], -potentials_[1][i],
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

}  // namespace

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
                product.row(row_of(row)) =
                    Eigen::Map<const Eigen::Matrix<double, 1, 6>>(&part[(row - first) * 6]) +
                    diagonal[row_of(row)] * columns.row(row_of(row));
            }
        }
    });
    return product;
}

CurvedEquations assemble_curved_equations(const CurvedPanels& panels, double tolerance,
                                          const BoundaryElementOptions& options) {
    CurvedEquations equations;
    equations.count = panels.nodes.size();
    equations.groups = (equations.count + group_size - 1) / group_size;
    equations.rows = LargeArray<float>(equations.groups * group_size * equations.count);
    equations.diagonal.resize(row_of(equations.count));
    equations.right_hand_sides.resize(row_of(equations.count), 6);
    Eigen::VectorXd row_errors(row_of(equations.count));
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

}  // namespace samara
