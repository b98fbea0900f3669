#include "samara/kirchhoff/operators/single_layer_matrix.hpp"

#include <algorithm>

#include "samara/core/base/parallel_for.hpp"

namespace samara {
namespace {

constexpr std::size_t rows_a_piece = 16;

Eigen::Index at(std::size_t index) {
    return static_cast<Eigen::Index>(index);
}

/// A triangle and which of its corners a node is.
struct Corner {
    std::size_t triangle;
    std::size_t corner;
};

std::vector<std::vector<Corner>> corners_of_nodes(const LinearElements& elements) {
    std::vector<std::vector<Corner>> result(elements.node_count());
    for (std::size_t t = 0; t < elements.triangle_count(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) result[elements.node(t, k)].push_back({t, k});
    }
    return result;
}

}  // namespace

RowMatrix dense_single_layer(const SingleLayerEntries& entries, int threads,
                             const std::function<void(double)>& progress) {
    const std::size_t count = entries.size();
    RowMatrix matrix(at(count), at(count));
    const std::size_t pieces = (count + rows_a_piece - 1) / rows_a_piece;
    // Rows from the top and from the bottom alternately: pieces of about equal work.
    parallel_for(
        pieces, 1, threads,
        [&](std::size_t begin, std::size_t) {
            const std::size_t piece = begin % 2 == 0 ? begin / 2 : pieces - 1 - begin / 2;
            const std::size_t end = std::min((piece + 1) * rows_a_piece, count);
            for (std::size_t i = piece * rows_a_piece; i < end; ++i) {
                entries.fill_row(i, i, count, &matrix(at(i), at(i)));
            }
        },
        progress);
    parallel_for(pieces, 1, threads, [&](std::size_t piece, std::size_t) {
        const Eigen::Index begin = at(piece * rows_a_piece);
        const Eigen::Index rows = std::min(at(rows_a_piece), at(count) - begin);
        matrix.block(begin, 0, rows, begin) = matrix.block(0, begin, begin, rows).transpose();
        for (Eigen::Index i = begin; i < begin + rows; ++i) {
            for (Eigen::Index j = begin; j < i; ++j) matrix(i, j) = matrix(j, i);
        }
    });
    return matrix;
}

RowMatrix dense_hypersingular(const LinearElements& elements, const RowMatrix& single_layer, int threads) {
    const auto corners = corners_of_nodes(elements);
    std::vector<std::array<Vector3d, 3>> curls(elements.triangle_count());
    for (std::size_t t = 0; t < curls.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) curls[t][k] = elements.curl(t, k);
    }
    RowMatrix matrix = RowMatrix::Zero(at(corners.size()), at(corners.size()));
    parallel_for(corners.size(), rows_a_piece, threads, [&](std::size_t begin, std::size_t end) {
        Eigen::Matrix<double, 3, Eigen::Dynamic> row(3, at(curls.size()));
        for (std::size_t i = begin; i < end; ++i) {
            row.setZero();
            for (const auto& [t, k] : corners[i]) row += curls[t][k] * single_layer.row(at(t));
            for (std::size_t t = 0; t < curls.size(); ++t) {
                for (std::size_t k = 0; k < 3; ++k) {
                    matrix(at(i), at(elements.node(t, k))) += row.col(at(t)).dot(curls[t][k]);
                }
            }
        }
    });
    return matrix;
}

}  // namespace samara
