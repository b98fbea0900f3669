#pragma once

#include <functional>

#include "samara/kirchhoff/panels/linear_elements.hpp"

namespace samara {

/// Loads on the surface from the normal velocities of the three unit rotations, g = x cross n.
struct RotationLoads {
    /// <(1/2 + D') g_a, v_i>, a row each node, a column each rotation; D' is the adjoint double layer.
    Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> loads;
    /// <g_a, S N_b> for the rotations a and all six motions b = (omega, v); S is the single layer.
    Eigen::Matrix<double, 3, 6> energies;
    /// The largest difference between the solid angle of all triangles from the middle of one and 2 pi, as a
    /// share of 4 pi; that is below 1e-3 on a closed surface, because distant triangles count as points.
    double closure_error;
};

/// Computes the loads of the unit rotations. Near pairs of triangles take the inner integral in closed form
/// at 16 outer points; distant ones three points each, and very distant ones one.
RotationLoads rotation_loads(const LinearElements& elements, int threads,
                             const std::function<void(double)>& progress = {});

}  // namespace samara
