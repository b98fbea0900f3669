#include "samara/core/surface/octahedral_map.hpp"

#include <algorithm>
#include <cmath>

namespace samara {
namespace {

double sign(double value) noexcept {
    return value < 0.0 ? -1.0 : 1.0;
}

}  // namespace

Eigen::Vector2d octahedral_coordinates(const Vector3d& direction) noexcept {
    const double norm = direction.lpNorm<1>();
    Eigen::Vector2d projected = direction.head<2>() / norm;
    if (direction.z() >= 0.0) return projected;
    return {(1.0 - std::abs(projected.y())) * sign(projected.x()),
            (1.0 - std::abs(projected.x())) * sign(projected.y())};
}

Vector3d octahedral_direction(const Eigen::Vector2d& coordinates) noexcept {
    const double x = coordinates.x();
    const double y = coordinates.y();
    const double z = 1.0 - std::abs(x) - std::abs(y);
    if (z >= 0.0) return Vector3d(x, y, z).normalized();
    return Vector3d((1.0 - std::abs(y)) * sign(x), (1.0 - std::abs(x)) * sign(y), z).normalized();
}

Vector3d octahedral_node(int subdivisions, int row, int column) noexcept {
    // Integers keep nodes that coincide on the sphere equal to the last bit.
    const int n = subdivisions;
    int x = column - n;
    int y = row - n;
    const int z = n - std::abs(x) - std::abs(y);
    if (z < 0) {
        const int folded_x = (n - std::abs(y)) * (x < 0 ? -1 : 1);
        const int folded_y = (n - std::abs(x)) * (y < 0 ? -1 : 1);
        x = folded_x;
        y = folded_y;
    }
    return Vector3d(x, y, z).normalized();
}

std::vector<Vector3d> octahedral_nodes(int subdivisions) {
    std::vector<Vector3d> nodes;
    for (int row = 0; row <= 2 * subdivisions; ++row) {
        for (int column = 0; column <= 2 * subdivisions; ++column) {
            nodes.push_back(octahedral_node(subdivisions, row, column));
        }
    }
    return nodes;
}

OctahedralCell octahedral_cell(int subdivisions, const Vector3d& direction) noexcept {
    const Eigen::Vector2d place =
        (octahedral_coordinates(direction).array() + 1.0).matrix() * static_cast<double>(subdivisions);
    const int last = 2 * subdivisions - 1;
    const int column = std::clamp(static_cast<int>(place.x()), 0, last);
    const int row = std::clamp(static_cast<int>(place.y()), 0, last);
    return {row, column, std::clamp(place.y() - row, 0.0, 1.0), std::clamp(place.x() - column, 0.0, 1.0)};
}

}  // namespace samara
