#pragma once

#include "samara/core/wind/wind_grid.hpp"

namespace samara {

/// Origin and numbers of nodes of a grid that covers a box (m) by its spacing. Throws Error where they would
/// be too many over all its frames.
void lay_nodes(WindGrid& grid, const Eigen::AlignedBox3d& box);

}  // namespace samara
