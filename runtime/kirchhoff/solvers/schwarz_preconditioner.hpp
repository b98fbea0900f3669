#pragma once

#include <vector>

#include "samara/kirchhoff/panels/linear_elements.hpp"
#include "samara/kirchhoff/panels/single_layer_entries.hpp"

namespace samara {

/// Additive Schwarz for the hypersingular matrix: exact inverses on overlapping clusters of nodes. A cluster
/// is a part of space, so it holds both faces of a thin body, whose modes of equal potential on both sides W
/// hardly resists.
class SchwarzPreconditioner {
  public:
    /// Clusters of up to `cluster_size` triangles. The result does not depend on `threads` (0: all cores).
    SchwarzPreconditioner(const LinearElements& elements, const SingleLayerEntries& entries,
                          std::size_t cluster_size, int threads);

    /// The sum of the clusters' solutions for the residuals.
    [[nodiscard]] SixColumns apply(const SixColumns& residuals, int threads) const;

    /// Bytes that the inverses take.
    [[nodiscard]] std::size_t memory() const;

  private:
    struct Part {
        std::vector<std::size_t> nodes;
        Eigen::MatrixXd factor;  // of Cholesky, lower
    };

    std::vector<Part> parts_;
};

}  // namespace samara
