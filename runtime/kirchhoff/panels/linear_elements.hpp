#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "samara/kirchhoff/panels/flat_triangle.hpp"

namespace samara {

/// One right-hand side or solution a column, one node or triangle a row.
using SixColumns = Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor>;

/// Continuous functions, linear on each flat triangle, on a closed surface: one unknown a vertex.
struct LinearElements {
    std::vector<Vector3d> nodes;
    std::vector<FlatTriangle> triangles;               ///< in the order of `tree`
    std::vector<std::array<std::int32_t, 3>> corners;  ///< rows of `nodes`
    ClusterTree tree;                                  ///< its order leads back to the surface's triangles
    std::vector<std::int32_t> component;  ///< of each node: index of its set of connected triangles
    std::int32_t component_count = 0;

    [[nodiscard]] std::size_t node_count() const { return nodes.size(); }
    [[nodiscard]] std::size_t triangle_count() const { return triangles.size(); }
    [[nodiscard]] std::size_t node(std::size_t triangle, std::size_t corner) const {
        return static_cast<std::size_t>(corners[triangle][corner]);
    }
    /// Returns n x grad of the function that is 1 at the corner and 0 at the others: constant on the
    /// triangle.
    [[nodiscard]] Vector3d curl(std::size_t triangle, std::size_t corner) const {
        const FlatTriangle& flat = triangles[triangle];
        const std::size_t opposite = (corner + 1) % 3;
        return flat.tangents[opposite] * (-0.5 * flat.lengths[opposite] / flat.area);
    }
};

/// Returns the elements of a welded surface of order 1, its triangles sorted into clusters of up to
/// `leaf_size`. Vertices that no triangle uses are left out. Throws Error at a triangle without an area.
LinearElements linear_elements(const Surface& surface, std::size_t leaf_size);

/// Takes the mean (weighted with the nodes' shares of the area) out of each component's columns: the
/// right-hand sides for which W has a solution.
void remove_component_sums(const LinearElements& elements, SixColumns& columns);

}  // namespace samara
