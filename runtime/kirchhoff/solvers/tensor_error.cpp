#include "samara/kirchhoff/solvers/tensor_error.hpp"

#include <algorithm>
#include <cmath>

#include "samara/core/surface/surface.hpp"

namespace samara {

double relative_tensor_error(const Matrix6d& tensor, const Matrix6d& reference, const TensorScale& scale,
                             double zero) {
    const double length = reference_length(scale.surface_area);
    const double coupling = std::max(
        scale.volume * length,
        std::sqrt(reference.topLeftCorner<3, 3>().norm() * reference.bottomRightCorner<3, 3>().norm()));
    const double block_scales[2][2] = {{scale.volume * length * length, coupling}, {coupling, scale.volume}};
    double error = 0.0;
    for (const Eigen::Index row : {0, 1}) {
        for (const Eigen::Index column : {0, 1}) {
            const Matrix3d block = reference.block<3, 3>(3 * row, 3 * column);
            const Matrix3d difference = tensor.block<3, 3>(3 * row, 3 * column) - block;
            const double block_scale = block_scales[row][column];
            const bool vanishes = block.norm() < zero * block_scale;
            error = std::max(error, difference.norm() / (vanishes ? block_scale : block.norm()));
        }
    }
    return error;
}

}  // namespace samara
