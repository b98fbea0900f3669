#pragma once

#include <cstddef>
#include <functional>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// Options of a boundary element method.
struct BoundaryElementOptions {
    int threads = 0;                            ///< 0: all cores; the result does not depend on it
    std::function<void(double)> progress = {};  ///< called with the share of the work done, 0 to 1
};

/// The result of one solve for the six unit motions. Its unit of length is the surface's.
struct BoundaryElementResult {
    Matrix6d tensor = Matrix6d::Zero();  ///< about the origin, fluid of density 1, not symmetrised
    double closure_error = 0.0;  ///< how far the solid angles of all triangles, seen from one, are from
                                 ///< their sum on a closed surface, as a share of the full one; the largest
    std::size_t unknowns = 0;
    int iterations = 0;      ///< of the solver; 0 where the matrix was factorised
    std::size_t memory = 0;  ///< bytes that the largest matrices took
};

}  // namespace samara
