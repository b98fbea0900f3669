#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// The directions of motion that a bake for a scene was planned for: nodes of an octahedral map of the
/// tables' axes, row by row. Elsewhere its tables are extrapolated.
struct PlannedRegion {
    int subdivisions = 0;               ///< of the map; 0: the bake covers all directions
    std::vector<std::uint8_t> planned;  ///< 1 or 0 for each of the (2 subdivisions + 1)^2 nodes
    std::string
        report;  ///< JSON: what the bake aimed at and reached (docs/explanation/what-a-scene-needs.md)

    /// Returns whether the node nearest to a direction (unit vector, map axes) is planned; true without a
    /// map.
    [[nodiscard]] bool holds(const Vector3d& direction) const noexcept;
};

}  // namespace samara
