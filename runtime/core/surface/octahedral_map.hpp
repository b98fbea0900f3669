#pragma once

#include <vector>

#include <Eigen/Core>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// The octahedral map of the unit sphere onto the square [-1, 1]^2: d is divided by |x| + |y| + |z|, and the
/// lower half (z < 0) is folded outwards over the square's edges. Cigolle et al., A Survey of Efficient
/// Representations for Independent Unit Vectors, JCGT 3(2), 2014, section 3. Returns the square's (column,
/// row) coordinates; at the pole z = -1 one of the four corners.
Eigen::Vector2d octahedral_coordinates(const Vector3d& direction) noexcept;

/// Returns the unit vector at a point of the square: the inverse of octahedral_coordinates().
Vector3d octahedral_direction(const Eigen::Vector2d& coordinates) noexcept;

/// Returns the unit vector at node (row, column) of the map whose octahedron edges are cut into
/// `subdivisions`: the square has 2 subdivisions + 1 nodes a side. Nodes on opposite halves of the square's
/// edge are the same direction, exactly.
Vector3d octahedral_node(int subdivisions, int row, int column) noexcept;

/// Returns all nodes, row by row, as LoadTables holds them; those on the square's edge more than once.
std::vector<Vector3d> octahedral_nodes(int subdivisions);

/// The cell of the map that holds a direction: the node of its least row and column, and the place in it from
/// 0 to 1.
struct OctahedralCell {
    int row;
    int column;
    double row_fraction;
    double column_fraction;
};
OctahedralCell octahedral_cell(int subdivisions, const Vector3d& direction) noexcept;

}  // namespace samara
