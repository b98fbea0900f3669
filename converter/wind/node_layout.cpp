#include "converter/wind/node_layout.hpp"

#include <cmath>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"

namespace samara {

void lay_nodes(WindGrid& grid, const Eigen::AlignedBox3d& box) {
    constexpr double most_nodes = 4e8;  // 4.8 GB
    grid.origin = box.min();
    auto nodes = static_cast<double>(grid.frames);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<Eigen::Index>(axis);
        const double intervals = std::ceil(box.sizes()[i] / grid.spacing[i] - 1e-6);
        nodes *= intervals + 1.0;
        if (nodes > most_nodes) {
            throw Error(fmt::format(
                "the wind would take more than {:g} nodes over all times; give a larger --spacing "
                "than {:g} m",
                most_nodes, grid.spacing.minCoeff()));
        }
        grid.nodes[axis] = static_cast<std::size_t>(intervals) + 1;
    }
}

}  // namespace samara
