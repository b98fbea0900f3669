#include "samara/kirchhoff/operators/cross_approximation.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

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
        const Vector overlaps =
            (left.leftCols(rank).transpose() * column).cwiseProduct(right.leftCols(rank).transpose() * row);
        squared_norm += 2.0 * overlaps.sum() + column.squaredNorm() * row.squaredNorm();
        left.col(rank) = column;
        right.col(rank) = row;
        ++rank;
    }
};

/// Returns the entry of largest modulus that is not used yet; -1: none is left.
Eigen::Index largest_unused(const Vector& values, const std::vector<bool>& used) {
    Eigen::Index best = -1;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
        if (used[static_cast<std::size_t>(i)]) continue;
        if (best < 0 || std::abs(values[i]) > std::abs(values[best])) best = i;
    }
    return best;
}

/// Cuts a product to the rank that the tolerance takes, by the eigenvalues of the small products of its
/// factors: squares of singular values, whose rounding is 1e-8 of the largest singular value.
LowRank cut(const Cross& cross, double tolerance) {
    const auto left = cross.left.leftCols(cross.rank);
    const auto right = cross.right.leftCols(cross.rank);
    const Eigen::LLT<Matrix> root(right.transpose() * right);
    const Matrix lower = root.matrixL();
    const Matrix inner = lower.transpose() * (left.transpose() * left) * lower;
    const Eigen::SelfAdjointEigenSolver<Matrix> squares(inner);
    const double allowed = tolerance * tolerance * squares.eigenvalues().sum();
    Eigen::Index kept = cross.rank;
    for (double rest = 0.0; kept > 1; --kept) {
        rest += std::max(squares.eigenvalues()[cross.rank - kept], 0.0);
        if (rest > allowed) break;
    }
    const Matrix vectors = squares.eigenvectors().rightCols(kept);
    const auto as_floats = [](const Matrix& matrix) {
        const Eigen::MatrixXf single = matrix.cast<float>();
        return std::vector<float>(single.data(), single.data() + single.size());
    };
    return {static_cast<std::size_t>(kept), as_floats(left * (lower * vectors)),
            as_floats(right * root.matrixU().solve(vectors))};
}

/// A block of the matrix and what its approximation leaves of it.
class Residual {
  public:
    Residual(const SingleLayerEntries& entries, IndexRange rows, IndexRange columns)
        : entries_(entries), rows_(rows), columns_(columns) {}

    [[nodiscard]] Vector row(const Cross& cross, Eigen::Index i) const {
        Vector values(static_cast<Eigen::Index>(columns_.size()));
        entries_.fill_row(rows_.begin + static_cast<std::size_t>(i), columns_.begin, columns_.end,
                          values.data());
        return values - cross.right.leftCols(cross.rank) * cross.left.row(i).head(cross.rank).transpose();
    }

    /// Returns a column of the remainder. V is symmetric: a column is a row.
    [[nodiscard]] Vector column(const Cross& cross, Eigen::Index j) const {
        Vector values(static_cast<Eigen::Index>(rows_.size()));
        entries_.fill_row(columns_.begin + static_cast<std::size_t>(j), rows_.begin, rows_.end,
                          values.data());
        return values - cross.left.leftCols(cross.rank) * cross.right.row(j).head(cross.rank).transpose();
    }

    /// Returns a row where more is left than `allowed` (the whole block's norm); -1: none is found. Looks at
    /// some rows and columns across the block: the pivots alone stop too soon where many rows are alike.
    [[nodiscard]] Eigen::Index bad_row(const Cross& cross, const std::vector<bool>& used_rows,
                                       double allowed) const {
        const auto row_count = static_cast<Eigen::Index>(rows_.size());
        const auto column_count = static_cast<Eigen::Index>(columns_.size());
        for (Eigen::Index k = 0; k < samples; ++k) {
            const Vector rest = column(cross, (2 * k + 1) * column_count / (2 * samples));
            if (rest.norm() * std::sqrt(static_cast<double>(column_count)) <= allowed) continue;
            if (const Eigen::Index pivot = largest_unused(rest, used_rows); pivot >= 0) return pivot;
        }
        for (Eigen::Index k = 0; k < samples; ++k) {
            const Eigen::Index i = (2 * k + 1) * row_count / (2 * samples);
            if (used_rows[static_cast<std::size_t>(i)]) continue;
            if (row(cross, i).norm() * std::sqrt(static_cast<double>(row_count)) > allowed) return i;
        }
        return -1;
    }

  private:
    static constexpr Eigen::Index samples = 3;

    const SingleLayerEntries& entries_;
    IndexRange rows_;
    IndexRange columns_;
};

}  // namespace

std::optional<LowRank> cross_approximation(const SingleLayerEntries& entries, IndexRange rows,
                                           IndexRange columns, double tolerance, std::size_t most_rank) {
    constexpr Eigen::Index first_guess = 16;
    const Residual residual(entries, rows, columns);
    const auto row_count = static_cast<Eigen::Index>(rows.size());
    const std::size_t ranks = std::min({2 * most_rank, rows.size(), columns.size()});
    Cross cross{Matrix(row_count, first_guess),
                Matrix(static_cast<Eigen::Index>(columns.size()), first_guess)};
    std::vector<bool> used_rows(rows.size(), false);
    std::vector<bool> used_columns(columns.size(), false);
    Eigen::Index pivot_row = row_count / 2;
    while (pivot_row >= 0) {
        if (static_cast<std::size_t>(cross.rank) == ranks) return std::nullopt;
        used_rows[static_cast<std::size_t>(pivot_row)] = true;
        Vector row = residual.row(cross, pivot_row);
        const Eigen::Index pivot_column = largest_unused(row, used_columns);
        if (row[pivot_column] == 0.0) break;  // the approximation equals the row
        used_columns[static_cast<std::size_t>(pivot_column)] = true;
        const Vector column = residual.column(cross, pivot_column);
        row /= row[pivot_column];
        cross.add(column, row);
        // A few times below the tolerance, because the step estimates what is left.
        const double allowed = 0.3 * tolerance * std::sqrt(std::max(cross.squared_norm, 0.0));
        const bool small_step = column.norm() * row.norm() < allowed;
        pivot_row =
            small_step ? residual.bad_row(cross, used_rows, allowed) : largest_unused(column, used_rows);
        if (pivot_row < 0 && !small_step) return std::nullopt;
    }
    LowRank result = cut(cross, tolerance);
    if (result.rank > most_rank) return std::nullopt;
    return result;
}

}  // namespace samara
