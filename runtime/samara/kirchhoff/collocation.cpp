#include "samara/kirchhoff/collocation.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/LU>
#include <Eigen/SparseLU>

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
constexpr double strong_entry = 0.01;  // of the matrix, whose diagonal is 1/2

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

/// The inverse of the strong entries of the matrix alone, as the preconditioner: it takes up the pairs of
/// panels that face each other across a thin body, which plain GMRES is slow on (a sheet of 1308 triangles:
/// 30 iterations instead of 175).
class NearFieldInverse {
  public:
    explicit NearFieldInverse(const RowMatrix& matrix) {
        std::vector<Eigen::Triplet<double>> entries;
        for (Eigen::Index row = 0; row < matrix.rows(); ++row) {
            for (Eigen::Index column = 0; column < matrix.cols(); ++column) {
                const double value = matrix(row, column);
                if (std::abs(value) > strong_entry) entries.emplace_back(row, column, value);
            }
        }
        Eigen::SparseMatrix<double> strong(matrix.rows(), matrix.cols());
        strong.setFromTriplets(entries.begin(), entries.end());
        factors_.compute(strong);
    }

    [[nodiscard]] Columns operator*(const Columns& columns) const {
        if (factors_.info() != Eigen::Success) return columns;
        return factors_.solve(columns);
    }

  private:
    Eigen::SparseLU<Eigen::SparseMatrix<double>> factors_;
};

Columns solve(const Equations& equations, int threads) {
    const NearFieldInverse near_field(equations.matrix);
    const auto times_matrix = [&](const Columns& columns) {
        return near_field * multiply(equations.matrix, columns, threads);
    };
    if (auto solution = block_gmres(times_matrix, near_field * equations.right_hand_sides, solver_tolerance,
                                    most_iterations)) {
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
