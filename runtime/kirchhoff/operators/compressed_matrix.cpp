#include "samara/kirchhoff/operators/compressed_matrix.hpp"

#include <algorithm>
#include <utility>

#include "samara/core/base/parallel_for.hpp"
#include "samara/kirchhoff/operators/cross_approximation.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "samara/kirchhoff/operators/compressed_matrix.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::ScalableTag<float>;
using Lanes = hn::Vec<Tag>;

constexpr std::size_t columns_at_once = 9;

/// Adds to result (rows x 18) the product matrix (rows x inner, column by column) times factor (inner x 18).
/// The strides are those of the 18 columns.
void add_product(const float* matrix, std::size_t rows, std::size_t inner, const float* factor,
                 std::size_t factor_stride, float* result, std::size_t result_stride) {
    const Tag tag;
    const std::size_t lanes = hn::Lanes(tag);
    for (std::size_t group = 0; group < 18; group += columns_at_once) {
        const float* columns = factor + group * factor_stride;
        float* out = result + group * result_stride;
        for (std::size_t i = 0; i < rows; i += lanes) {
            const std::size_t count = std::min(lanes, rows - i);
            const auto present = hn::FirstN(tag, count);
            const bool whole = count == lanes;
            Lanes sums[columns_at_once];
            for (auto& sum : sums) sum = hn::Zero(tag);
            for (std::size_t k = 0; k < inner; ++k) {
                const float* place = matrix + k * rows + i;
                const Lanes entry = whole ? hn::LoadU(tag, place) : hn::MaskedLoad(present, tag, place);
                for (std::size_t c = 0; c < columns_at_once; ++c) {
                    sums[c] = hn::MulAdd(entry, hn::Set(tag, columns[c * factor_stride + k]), sums[c]);
                }
            }
            for (std::size_t c = 0; c < columns_at_once; ++c) {
                float* place = out + c * result_stride + i;
                if (whole) {
                    hn::StoreU(hn::Add(hn::LoadU(tag, place), sums[c]), tag, place);
                } else {
                    hn::BlendedStore(hn::Add(hn::MaskedLoad(present, tag, place), sums[c]), present, tag,
                                     place);
                }
            }
        }
    }
}

/// Adds to result (inner x 18) the product transpose of matrix (rows x inner, column by column) times factor
/// (rows x 18).
void add_transposed_product(const float* matrix, std::size_t rows, std::size_t inner, const float* factor,
                            std::size_t factor_stride, float* result, std::size_t result_stride) {
    const Tag tag;
    const std::size_t lanes = hn::Lanes(tag);
    for (std::size_t group = 0; group < 18; group += columns_at_once) {
        const float* columns = factor + group * factor_stride;
        float* out = result + group * result_stride;
        for (std::size_t k = 0; k < inner; ++k) {
            Lanes sums[columns_at_once];
            for (auto& sum : sums) sum = hn::Zero(tag);
            std::size_t i = 0;
            for (; i + lanes <= rows; i += lanes) {
                const Lanes entry = hn::LoadU(tag, matrix + k * rows + i);
                for (std::size_t c = 0; c < columns_at_once; ++c) {
                    sums[c] = hn::MulAdd(entry, hn::LoadU(tag, columns + c * factor_stride + i), sums[c]);
                }
            }
            if (i < rows) {
                const auto present = hn::FirstN(tag, rows - i);
                const Lanes entry = hn::MaskedLoad(present, tag, matrix + k * rows + i);
                for (std::size_t c = 0; c < columns_at_once; ++c) {
                    const Lanes value = hn::MaskedLoad(present, tag, columns + c * factor_stride + i);
                    sums[c] = hn::MulAdd(entry, value, sums[c]);
                }
            }
            for (std::size_t c = 0; c < columns_at_once; ++c) {
                out[c * result_stride + k] += hn::GetLane(hn::SumOfLanes(tag, sums[c]));
            }
        }
    }
}

/// Adds what the block and its mirror image across the diagonal contribute to matrix times columns.
void add_block(const CompressedMatrix::Block& block, const CurlColumns& columns, std::vector<float>& middle,
               CurlColumns& result) {
    const auto stride = static_cast<std::size_t>(columns.rows());
    const float* row_factor = columns.data() + block.row_begin;
    const float* column_factor = columns.data() + block.column_begin;
    float* row_result = result.data() + block.row_begin;
    float* column_result = result.data() + block.column_begin;
    if (!block.right.empty()) {
        middle.assign(36 * block.rank, 0.0F);
        float* second = middle.data() + 18 * block.rank;
        add_transposed_product(block.right.data(), block.columns, block.rank, column_factor, stride,
                               middle.data(), block.rank);
        add_transposed_product(block.left.data(), block.rows, block.rank, row_factor, stride, second,
                               block.rank);
        add_product(block.left.data(), block.rows, block.rank, middle.data(), block.rank, row_result, stride);
        add_product(block.right.data(), block.columns, block.rank, second, block.rank, column_result, stride);
        return;
    }
    add_product(block.left.data(), block.rows, block.columns, column_factor, stride, row_result, stride);
    if (block.row_begin != block.column_begin) {
        add_transposed_product(block.left.data(), block.rows, block.columns, row_factor, stride,
                               column_result, stride);
    }
}

}  // namespace
}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace samara {
namespace {

HWY_EXPORT(add_block);

// Clusters are far from each other where the smaller box's diagonal is below this times their distance.
constexpr double most_diameter = 2.0;
// Sums are made in this many parts whatever the number of threads, so that they round alike.
constexpr std::size_t group_count = 8;

using Block = CompressedMatrix::Block;

bool is_far(const Cluster& a, const Cluster& b) {
    return std::min(box_diameter(a), box_diameter(b)) < most_diameter * box_distance(a, b);
}

/// Cuts the part of the matrix above the diagonal that belongs to two clusters into blocks.
void add_blocks(const ClusterTree& tree, std::size_t a, std::size_t b, std::vector<Block>& blocks) {
    const Cluster& rows = tree.clusters[a];
    const Cluster& columns = tree.clusters[b];
    const bool far = a != b && is_far(rows, columns);
    if (far || (rows.is_leaf() && columns.is_leaf())) {
        blocks.push_back({rows.begin, rows.size(), columns.begin, columns.size(), far});
        return;
    }
    if (a == b) {
        add_blocks(tree, rows.left, rows.left, blocks);
        add_blocks(tree, rows.left, rows.right, blocks);
        add_blocks(tree, rows.right, rows.right, blocks);
    } else if (columns.is_leaf() || (!rows.is_leaf() && box_diameter(rows) > box_diameter(columns))) {
        add_blocks(tree, rows.left, b, blocks);
        add_blocks(tree, rows.right, b, blocks);
    } else {
        add_blocks(tree, a, columns.left, blocks);
        add_blocks(tree, a, columns.right, blocks);
    }
}

void fill_in_full(const SingleLayerEntries& entries, Block& block) {
    block.left.resize(block.rows * block.columns);
    block.right.clear();
    block.rank = 0;
    std::vector<double> row(block.columns);
    for (std::size_t i = 0; i < block.rows; ++i) {
        // On the diagonal a row starts at its own column, so that each pair is integrated once.
        const std::size_t skipped = block.row_begin == block.column_begin ? i : 0;
        entries.fill_row(block.row_begin + i, block.column_begin + skipped,
                         block.column_begin + block.columns, row.data() + skipped);
        for (std::size_t j = skipped; j < block.columns; ++j) {
            block.left[j * block.rows + i] = static_cast<float>(row[j]);
            if (skipped > 0 || block.row_begin == block.column_begin) {
                block.left[i * block.rows + j] = static_cast<float>(row[j]);
            }
        }
    }
}

void fill(const SingleLayerEntries& entries, double tolerance, Block& block) {
    if (block.is_far) {
        const std::size_t most_rank = block.rows * block.columns / (block.rows + block.columns);
        auto factors = cross_approximation(entries, {block.row_begin, block.row_begin + block.rows},
                                           {block.column_begin, block.column_begin + block.columns},
                                           tolerance, most_rank);
        if (factors) {
            block.rank = factors->rank;
            block.left = std::move(factors->left);
            block.right = std::move(factors->right);
            return;
        }
    }
    fill_in_full(entries, block);
}

std::size_t work_of(const Block& block) {
    return block.left.size() + block.right.size();
}

/// Returns the blocks in parts of about equal work.
std::vector<std::vector<std::size_t>> grouped(const std::vector<Block>& blocks) {
    std::size_t all = 0;
    for (const Block& block : blocks) all += work_of(block);
    std::vector<std::vector<std::size_t>> groups(group_count);
    std::size_t done = 0;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        groups[std::min(group_count - 1, done * group_count / std::max<std::size_t>(all, 1))].push_back(i);
        done += work_of(blocks[i]);
    }
    return groups;
}

/// Places in a list, and the triangles of a block that stand there.
struct ListPart {
    std::size_t begin = 0;
    std::size_t end = 0;
};

ListPart part_within(const std::vector<std::size_t>& triangles, std::size_t begin, std::size_t size) {
    const auto place = [&](std::size_t triangle) {
        return static_cast<std::size_t>(std::lower_bound(triangles.begin(), triangles.end(), triangle) -
                                        triangles.begin());
    };
    return {place(begin), place(begin + size)};
}

/// Returns some rows of a block's factor, whose first row is the triangle `first`.
Eigen::MatrixXf rows_of(const std::vector<float>& factor, std::size_t rows, std::size_t columns,
                        std::size_t first, const std::vector<std::size_t>& triangles, const ListPart& part) {
    Eigen::MatrixXf result(eigen_index(part.end - part.begin), eigen_index(columns));
    for (std::size_t j = 0; j < columns; ++j) {
        for (std::size_t i = part.begin; i < part.end; ++i) {
            result(eigen_index(i - part.begin), eigen_index(j)) = factor[j * rows + triangles[i] - first];
        }
    }
    return result;
}

}  // namespace

Eigen::MatrixXd CompressedMatrix::part(const std::vector<std::size_t>& triangles) const {
    Eigen::MatrixXd result(eigen_index(triangles.size()), eigen_index(triangles.size()));
    for (const Block& block : blocks_) {
        const ListPart rows = part_within(triangles, block.row_begin, block.rows);
        if (rows.begin == rows.end) continue;
        const ListPart columns = part_within(triangles, block.column_begin, block.columns);
        if (columns.begin == columns.end) continue;
        Eigen::MatrixXf values;
        if (block.right.empty()) {
            values.resize(eigen_index(rows.end - rows.begin), eigen_index(columns.end - columns.begin));
            for (std::size_t j = columns.begin; j < columns.end; ++j) {
                const float* column = block.left.data() + (triangles[j] - block.column_begin) * block.rows;
                for (std::size_t i = rows.begin; i < rows.end; ++i) {
                    values(eigen_index(i - rows.begin), eigen_index(j - columns.begin)) =
                        column[triangles[i] - block.row_begin];
                }
            }
        } else {
            values = rows_of(block.left, block.rows, block.rank, block.row_begin, triangles, rows) *
                     rows_of(block.right, block.columns, block.rank, block.column_begin, triangles, columns)
                         .transpose();
        }
        result.block(eigen_index(rows.begin), eigen_index(columns.begin), values.rows(), values.cols()) =
            values.cast<double>();
        result.block(eigen_index(columns.begin), eigen_index(rows.begin), values.cols(), values.rows()) =
            values.transpose().cast<double>();
    }
    return result;
}

CompressedMatrix::CompressedMatrix(const SingleLayerEntries& entries, const ClusterTree& tree,
                                   double tolerance, int threads, const std::function<void(double)>& progress)
    : size_(entries.size()) {
    add_blocks(tree, 0, 0, blocks_);
    parallel_for(
        blocks_.size(), 1, threads,
        [&](std::size_t begin, std::size_t) { fill(entries, tolerance, blocks_[begin]); }, progress);
    groups_ = grouped(blocks_);
}

CurlColumns CompressedMatrix::times(const CurlColumns& columns, int threads) const {
    std::vector<CurlColumns> parts(groups_.size());
    parallel_for(groups_.size(), 1, threads, [&](std::size_t group, std::size_t) {
        parts[group].setZero(columns.rows(), 18);
        std::vector<float> middle;
        for (const std::size_t i : groups_[group]) {
            HWY_DYNAMIC_DISPATCH(add_block)(blocks_[i], columns, middle, parts[group]);
        }
    });
    for (std::size_t group = 1; group < parts.size(); ++group) parts[0] += parts[group];
    return parts[0];
}

std::size_t CompressedMatrix::memory() const {
    std::size_t floats = 0;
    for (const Block& block : blocks_) floats += work_of(block);
    return floats * sizeof(float);
}

}  // namespace samara
#endif
