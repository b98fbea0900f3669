#include "samara/body/load_tables.hpp"

#include <algorithm>
#include <cmath>

#include "samara/body/octahedral_map.hpp"

namespace samara {
namespace {

void add_weighted(LoadEntry& sum, const LoadEntry& entry, double weight) noexcept {
    sum.force += weight * entry.force;
    sum.moment += weight * entry.moment;
    sum.turbulent_kinetic_energy += weight * entry.turbulent_kinetic_energy;
    sum.dissipation_rate += weight * entry.dissipation_rate;
}

/// The cell that holds a coordinate counted in node spacings, and the place within it from 0 to 1.
struct Cell {
    int index;
    double fraction;
};

Cell cell_of(double coordinate, int cells) noexcept {
    const int index = std::clamp(static_cast<int>(coordinate), 0, cells - 1);
    return {index, std::clamp(coordinate - index, 0.0, 1.0)};
}

/// The place of a Reynolds number between the table's, in log Re, held at both ends.
Cell reynolds_cell(const std::vector<double>& reynolds_numbers, double reynolds_number) noexcept {
    const auto count = static_cast<int>(reynolds_numbers.size());
    if (count == 1 || !(reynolds_number > reynolds_numbers.front())) return {0, 0.0};
    if (reynolds_number >= reynolds_numbers.back()) return {count - 2, 1.0};
    const auto above = std::upper_bound(reynolds_numbers.begin(), reynolds_numbers.end(), reynolds_number);
    const auto below = above - 1;
    return {static_cast<int>(below - reynolds_numbers.begin()),
            std::log(reynolds_number / *below) / std::log(*above / *below)};
}

}  // namespace

LoadEntry look_up(const LoadTables& tables, const Vector3d& direction, double reynolds_number) noexcept {
    const Eigen::Vector2d place = octahedral_coordinates(tables.axes.transpose() * direction);
    const int cells = 2 * tables.subdivisions;
    const Cell column = cell_of((place.x() + 1.0) * tables.subdivisions, cells);
    const Cell row = cell_of((place.y() + 1.0) * tables.subdivisions, cells);
    const Cell reynolds = reynolds_cell(tables.reynolds_numbers, reynolds_number);

    LoadEntry result;
    for (int corner = 0; corner < 8; ++corner) {
        const int up = corner & 1;
        const int right = (corner >> 1) & 1;
        const int later = (corner >> 2) & 1;
        const double weight = (up != 0 ? row.fraction : 1.0 - row.fraction) *
                              (right != 0 ? column.fraction : 1.0 - column.fraction) *
                              (later != 0 ? reynolds.fraction : 1.0 - reynolds.fraction);
        if (weight == 0.0) continue;  // also keeps a table with one Reynolds number inside its bounds
        add_weighted(
            result,
            tables.entries[tables.index(reynolds.index + later, row.index + up, column.index + right)],
            weight);
    }
    return result;
}

}  // namespace samara
