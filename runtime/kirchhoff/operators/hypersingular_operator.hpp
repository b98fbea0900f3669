#pragma once

#include "samara/kirchhoff/operators/compressed_matrix.hpp"
#include "samara/kirchhoff/panels/linear_elements.hpp"

namespace samara {

/// W p = sum over triangles of curl v_i . V curl p for six columns, V compressed.
SixColumns hypersingular_times(const LinearElements& elements, const CompressedMatrix& single_layer,
                               const SixColumns& columns, int threads);

}  // namespace samara
