#pragma once

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// Volume and area that give the scales of a Kirchhoff tensor's blocks, with L = sqrt(S / pi).
struct TensorScale {
    double volume = 0.0;        ///< V (m^3)
    double surface_area = 0.0;  ///< S (m^2)
};

/// Returns the relative tensor error: the largest, over the angular, coupling and translational blocks, of
/// the Frobenius norm of the difference over that of the reference's block. A block of the reference counts
/// as zero where its norm is below `zero` times its scale, and is then measured by the scale: V L^2 for the
/// angular block, V for the translational one, and for the coupling block V L or, where it is larger, as on
/// thin bodies, the geometric mean of the norms of the other two.
double relative_tensor_error(const Matrix6d& tensor, const Matrix6d& reference, const TensorScale& scale,
                             double zero = 1e-3);

}  // namespace samara
