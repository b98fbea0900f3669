#pragma once

#include <functional>

#include "samara/kirchhoff/panels/linear_elements.hpp"
#include "samara/kirchhoff/panels/single_layer_entries.hpp"

namespace samara {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Returns the dense single-layer matrix of the entries; each pair of triangles is integrated once.
RowMatrix dense_single_layer(const SingleLayerEntries& entries, int threads,
                             const std::function<void(double)>& progress = {});

/// Returns the dense hypersingular matrix <W v_j, v_i> = sum over triangles of curl v_i . V curl v_j
/// (Nedelec's form), whose null space is the constants on each component.
RowMatrix dense_hypersingular(const LinearElements& elements, const RowMatrix& single_layer, int threads);

}  // namespace samara
