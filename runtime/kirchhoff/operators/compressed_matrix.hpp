#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

#include "samara/kirchhoff/panels/flat_triangle.hpp"
#include "samara/kirchhoff/panels/single_layer_entries.hpp"

namespace samara {

/// Three curl components of six right-hand sides, triangle by triangle; column by column in memory.
using CurlColumns = Eigen::Matrix<float, Eigen::Dynamic, 18>;

/// The single-layer matrix of many triangles: blocks of distant clusters as products of low rank by adaptive
/// cross approximation (Bebendorf and Rjasanow, Computing 70, 2003), near ones in full, only those above the
/// diagonal, in single precision: its rounding, 6e-8, is below what the integrals are good to.
class CompressedMatrix {
  public:
    /// Compresses `entries`, which are in the order of `tree`. `tolerance`: a block's error relative to its
    /// norm. The result does not depend on `threads` (0: all cores).
    CompressedMatrix(const SingleLayerEntries& entries, const ClusterTree& tree, double tolerance,
                     int threads, const std::function<void(double)>& progress = {});

    /// Returns the matrix times 18 columns.
    [[nodiscard]] CurlColumns times(const CurlColumns& columns, int threads) const;

    /// Returns the rows and columns of some triangles, whose indices ascend.
    [[nodiscard]] Eigen::MatrixXd part(const std::vector<std::size_t>& triangles) const;

    /// Returns the bytes that the blocks take.
    [[nodiscard]] std::size_t memory() const;

    /// A block of rows and columns. In full: `left` is rows x columns, column by column, and `right` is
    /// empty. Of low rank: `left` (rows x rank) times the transpose of `right` (columns x rank).
    struct Block {
        std::size_t row_begin;
        std::size_t rows;
        std::size_t column_begin;
        std::size_t columns;
        bool is_far;
        std::size_t rank = 0;
        std::vector<float> left = {};
        std::vector<float> right = {};
    };

  private:
    std::size_t size_;
    std::vector<Block> blocks_;
    std::vector<std::vector<std::size_t>> groups_;  // of blocks, of about equal work
};

}  // namespace samara
