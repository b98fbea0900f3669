#include "samara/kirchhoff/cross_approximation.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/QR>
#include <Eigen/SVD>

namespace samara {
namespace {

using Matrix = Eigen::MatrixXd;
using Vector = Eigen::VectorXd;

/// The factors while they grow.
struct Cross {
    Matrix left;
    Matrix right;
    Eigen::Index rank = 0;
    double squared_norm = 0.0;

    void add(const Vector& column, const Vector& row) {
        if (rank == left.cols()) {
            left.conservativeResize(Eigen::NoChange, 2 * rank);
            right.conservativeResize(Eigen::NoChange, 2 * rank);
        }
        const Vector overlaps = (left.leftCols(rank).transpose() * column)
                                    .cwiseProduct(right.leftCols(rank).transpose() * row);
        squared_norm += 2.0 * overlaps.sum() + column.squaredNorm() * row.squaredNorm();
        left.col(rank) = column;
        right.col(rank) = row;
        ++rank;
    }
};

/// The entry of largest modulus that is not used yet; -1: none is left.
Eigen::Index largest_unused(const Vector& values, const std::vector<bool>& used) {
    Eigen::Index best = -1;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
        if (used[static_cast<std::size_t>(i)]) continue;
        if (best < 0 || std::abs(values[i]) > std::abs(values[best])) best = i;
    }
    return best;
}

/// QR of both factors and the singular values of the small product in between.
LowRank cut(const Cross& cross, double tolerance) {
    const Eigen::Index rank = cross.rank;
    const Eigen::HouseholderQR<Matrix> left(cross.left.leftCols(rank));
    const Eigen::HouseholderQR<Matrix> right(cross.right.leftCols(rank));
    const Matrix left_triangle = left.matrixQR().topRows(rank).template triangularView<Eigen::Upper>();
    const Matrix right_triangle = right.matrixQR().topRows(rank).template triangularView<Eigen::Upper>();
    const Eigen::JacobiSVD<Matrix> values(left_triangle * right_triangle.transpose(),
                                          Eigen::ComputeThinU | Eigen::ComputeThinV);
    const Vector& singular = values.singularValues();
    const double allowed = tolerance * tolerance * singular.squaredNorm();
    Eigen::Index kept = rank;
    for (double rest = 0.0; kept > 1; --kept) {
        rest += singular[kept - 1] * singular[kept - 1];
        if (rest > allowed) break;
    }
    Matrix small_left = Matrix::Zero(cross.left.rows(), kept);
    small_left.topRows(rank) = values.matrixU().leftCols(kept) * singular.head(kept).asDiagonal();
    Matrix small_right = Matrix::Zero(cross.right.rows(), kept);
    small_right.topRows(rank) = values.matrixV().leftCols(kept);
    small_left.applyOnTheLeft(left.householderQ());
    small_right.applyOnTheLeft(right.householderQ());
    LowRank result{static_cast<std::size_t>(kept), {}, {}};
    const auto as_floats = [](const Matrix& matrix) {
        const Eigen::MatrixXf single = matrix.cast<float>();
        return std::vector<float>(single.data(), single.data() + single.size());
    };
    result.left = as_floats(small_left);
    result.right = as_floats(small_right);
    return result;
}

}  // namespace

std::optional<LowRank> cross_approximation(const SingleLayerEntries& entries, IndexRange rows,
                                           IndexRange columns, double tolerance, std::size_t most_rank) {
    constexpr Eigen::Index first_guess = 16;
    const auto row_count = static_cast<Eigen::Index>(rows.size());
    const auto column_count = static_cast<Eigen::Index>(columns.size());
    const std::size_t ranks = std::min({2 * most_rank, rows.size(), columns.size()});
    Cross cross{Matrix(row_count, first_guess), Matrix(column_count, first_guess)};
    std::vector<bool> used_rows(rows.size(), false);
    std::vector<bool> used_columns(columns.size(), false);
    Vector row(column_count);
    Vector column(row_count);
    Eigen::Index pivot_row = row_count / 2;
    while (static_cast<std::size_t>(cross.rank) < ranks) {
        used_rows[static_cast<std::size_t>(pivot_row)] = true;
        const auto matrix_row = rows.begin + static_cast<std::size_t>(pivot_row);
        entries.fill_row(matrix_row, columns.begin, columns.end, row.data());
        row -= cross.right.leftCols(cross.rank) * cross.left.row(pivot_row).head(cross.rank).transpose();
        const Eigen::Index pivot_column = largest_unused(row, used_columns);
        if (pivot_column < 0 || row[pivot_column] == 0.0) break;
        used_columns[static_cast<std::size_t>(pivot_column)] = true;
        // V is symmetric: a column is a row.
        const auto matrix_column = columns.begin + static_cast<std::size_t>(pivot_column);
        entries.fill_row(matrix_column, rows.begin, rows.end, column.data());
        column -= cross.left.leftCols(cross.rank) * cross.right.row(pivot_column).head(cross.rank).transpose();
        row /= row[pivot_column];
        cross.add(column, row);
        const double step = column.norm() * row.norm();
        // A few times below the tolerance, because the step estimates what is left.
        if (step < 0.3 * tolerance * std::sqrt(std::max(cross.squared_norm, 0.0))) break;
        pivot_row = largest_unused(column, used_rows);
        if (pivot_row < 0) break;
    }
    if (cross.rank == 0) return LowRank{1, std::vector<float>(rows.size()), std::vector<float>(columns.size())};
    LowRank result = cut(cross, tolerance);
    if (result.rank > most_rank) return std::nullopt;
    return result;
}

}  // namespace samara
