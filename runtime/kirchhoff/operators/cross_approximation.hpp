#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "samara/kirchhoff/panels/single_layer_entries.hpp"

namespace samara {

/// Rows or columns from `begin` to `end`.
struct IndexRange {
    std::size_t begin;
    std::size_t end;

    [[nodiscard]] std::size_t size() const { return end - begin; }
};

/// left (rows x rank) times the transpose of right (columns x rank), both column by column.
struct LowRank {
    std::size_t rank = 0;
    std::vector<float> left;
    std::vector<float> right;
};

/// Returns a block of the single-layer matrix between distant clusters as a product of low rank, by adaptive
/// cross approximation with partial pivoting (Bebendorf and Rjasanow, Computing 70, 2003), to about
/// `tolerance` relative to the block's Frobenius norm, and then cut to the rank that this takes. Nothing
/// where that is more than `most_rank`.
std::optional<LowRank> cross_approximation(const SingleLayerEntries& entries, IndexRange rows,
                                           IndexRange columns, double tolerance, std::size_t most_rank);

}  // namespace samara
