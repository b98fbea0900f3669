#include "samara/kirchhoff/collocation.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "samara/base/parallel_for.hpp"
#include "samara/kirchhoff/block_gmres.hpp"
#include "samara/kirchhoff/influence.hpp"

namespace samara {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using RowColumns = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

constexpr std::size_t rows_a_piece = 16;
constexpr double solver_tolerance = 1e-10;  // far below the elements' error
constexpr int most_iterations = 120;

/// The discrete equations A phi' = b: six columns in the order (omega, v).
struct Equations {
    RowMatrix matrix;          // 1/2 - D
    Columns right_hand_sides;  // -S (x cross n) for omega, -x for v
    Eigen::VectorXd row_faults;
};

Eigen::Index row_of(std::size_t index) {
    return static_cast<Eigen::Index>(index);
}

/// Fills the rows of the panels from `begin` to `end`.
void fill_rows(const Panels& panels, std::size_t begin, std::size_t end, Equations& equations) {
    const std::size_t count = panels.panels.size();
    InfluenceRow row(panels);
    for (std::size_t i = begin; i < end; ++i) {
        row.move_to(i);
        double sum = 0.0;
        Vector3d potential = Vector3d::Zero();
        for (std::size_t j = 0; j < count; ++j) {
            const double share = row.solid_angle_share(j);
            const Panel& panel = panels.panels[j];
            equations.matrix(row_of(i), row_of(j)) = share;
            sum += share;
            potential += row.source_potential(j, share) * panel.centroid.cross(panel.normal);
        }
        // (1/2 - D) 1 = 1 holds on every closed surface: it sets the diagonal.
        equations.matrix(row_of(i), row_of(i)) = 1.0 - sum;
        equations.row_faults[row_of(i)] = std::abs(sum - 0.5);
        equations.right_hand_sides.row(row_of(i)) << -potential.transpose(),
            -panels.panels[i].centroid.transpose();
    }
}

Equations assemble(const Panels& panels, int threads, const std::function<void(double)>& progress) {
    const Eigen::Index count = row_of(panels.panels.size());
    Equations equations{RowMatrix(count, count), Columns(count, 6), Eigen::VectorXd(count)};
    parallel_for(
        panels.panels.size(), rows_a_piece, threads,
        [&](std::size_t begin, std::size_t end) { fill_rows(panels, begin, end, equations); }, progress);
    return equations;
}

Columns multiply(const RowMatrix& matrix, const Columns& columns, int threads) {
    const RowColumns right = columns;
    Columns product(columns.rows(), columns.cols());
    parallel_for(static_cast<std::size_t>(matrix.rows()), rows_a_piece, threads,
                 [&](std::size_t begin, std::size_t end) {
                     const Eigen::Index size = row_of(end - begin);
                     const RowColumns part = matrix.middleRows(row_of(begin), size) * right;
                     product.middleRows(row_of(begin), size) = part;
                 });
    return product;
}

Columns solve(const Equations& equations, int threads) {
    const auto times_matrix = [&](const Columns& columns) {
        return multiply(equations.matrix, columns, threads);
    };
    if (auto solution =
            block_gmres(times_matrix, equations.right_hand_sides, solver_tolerance, most_iterations)) {
        return *solution;
    }
    return Eigen::MatrixXd(equations.matrix).partialPivLu().solve(equations.right_hand_sides);
}

}  // namespace

CollocationResult solve_collocation(const Panels& panels, double most_closure_fault, int threads,
                                    const std::function<void(double)>& progress) {
    const Equations equations = assemble(panels, threads, progress);
    CollocationResult result{Matrix6d::Zero(), equations.row_faults.maxCoeff()};
    if (!(result.closure_fault <= most_closure_fault)) return result;
    const Columns solution = solve(equations, threads);
    for (std::size_t j = 0; j < panels.panels.size(); ++j) {
        const Panel& panel = panels.panels[j];
        Vector6d potential = solution.row(row_of(j)).transpose();
        potential.tail<3>() += panel.centroid;  // phi = psi + x for translations
        Vector6d normal;
        normal << panel.centroid.cross(panel.normal), panel.normal;
        result.tensor -= panel.area * potential * normal.transpose();
    }
    return result;
}

}  // namespace samara
