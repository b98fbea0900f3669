#pragma once

#include <array>
#include <optional>

namespace samara {

/// The convergence of a value over three meshes.
struct MeshOrder {
    double order;  ///< observed order: the error falls as the cells' edge to this power
    double
        uncertainty;  ///< grid convergence index of the finest mesh: 1.25 times the estimated error, relative
};

/// Returns the observed order of a value over three meshes, given from the coarsest to the finest with their
/// numbers of cells, by the procedure of Celik et al. (J. Fluids Eng. 130, 078001, 2008), whose edge of a
/// cell is the cubic root of the mean volume. Nothing where the value oscillates or does not converge over
/// the meshes, or the meshes do not become finer: no order exists then.
std::optional<MeshOrder> observed_order(const std::array<double, 3>& cells,
                                        const std::array<double, 3>& values);

}  // namespace samara
