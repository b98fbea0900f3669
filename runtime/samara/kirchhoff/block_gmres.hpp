#pragma once

#include <functional>
#include <optional>

#include <Eigen/Core>

namespace samara {

/// One right-hand side and one solution a column.
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 6>;

/// Solves A X = B for six right-hand sides at once, so that the matrix is read once for all six in every
/// iteration: GMRES without restart (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7(3), 1986), each column
/// with its own Krylov space. `multiply` returns A times six columns. Ends where every column's residual is
/// below `tolerance` times its right-hand side; returns nothing where that takes more than `most_iterations`.
std::optional<Columns> block_gmres(const std::function<Columns(const Columns&)>& multiply,
                                   const Columns& right_hand_sides, double tolerance, int most_iterations);

}  // namespace samara
