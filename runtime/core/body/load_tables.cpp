#include "samara/core/body/load_tables.hpp"

#include <algorithm>
#include <cmath>

#include "samara/core/base/numbers.hpp"
#include "samara/core/body/planned_region.hpp"
#include "samara/core/body/table_errors.hpp"
#include "samara/core/surface/octahedral_map.hpp"

namespace samara {

const char* name_of(TurbulenceMean mean) {
    return mean == TurbulenceMean::shell ? "shell" : "near wake";
}

namespace {

void add_weighted(LoadEntry& sum, const LoadEntry& entry, double weight) noexcept {
    sum.force += weight * entry.force;
    sum.moment += weight * entry.moment;
    sum.turbulent_kinetic_energy += weight * entry.turbulent_kinetic_energy;
    sum.dissipation_rate += weight * entry.dissipation_rate;
}

struct ReynoldsCell {
    int index;
    double fraction;
};

/// Returns the place of a Reynolds number between the table's, in log Re, held at both ends.
ReynoldsCell reynolds_cell(const std::vector<double>& reynolds_numbers, double reynolds_number) noexcept {
    const auto count = static_cast<int>(reynolds_numbers.size());
    if (count == 1 || !(reynolds_number > reynolds_numbers.front())) return {0, 0.0};
    if (reynolds_number >= reynolds_numbers.back()) return {count - 2, 1.0};
    const auto above = std::upper_bound(reynolds_numbers.begin(), reynolds_numbers.end(), reynolds_number);
    const auto below = above - 1;
    return {static_cast<int>(below - reynolds_numbers.begin()),
            std::log(reynolds_number / *below) / std::log(*above / *below)};
}

/// Interpolates entries or errors of the tables, bilinearly on the map and linearly in log Re.
LoadEntry interpolated(const LoadTables& tables, const std::vector<LoadEntry>& entries,
                       const Vector3d& direction, double reynolds_number) noexcept {
    const OctahedralCell cell = octahedral_cell(tables.subdivisions, tables.axes.transpose() * direction);
    const ReynoldsCell reynolds = reynolds_cell(tables.reynolds_numbers, reynolds_number);

    LoadEntry result;
    for (int corner = 0; corner < 8; ++corner) {
        const int up = corner & 1;
        const int right = (corner >> 1) & 1;
        const int later = (corner >> 2) & 1;
        const double weight = (up != 0 ? cell.row_fraction : 1.0 - cell.row_fraction) *
                              (right != 0 ? cell.column_fraction : 1.0 - cell.column_fraction) *
                              (later != 0 ? reynolds.fraction : 1.0 - reynolds.fraction);
        if (weight == 0.0) continue;  // also keeps a table of one Reynolds number within its bounds
        add_weighted(result,
                     entries[tables.index(reynolds.index + later, cell.row + up, cell.column + right)],
                     weight);
    }
    return result;
}

constexpr const char* names[error_source_count] = {"tail", "symmetry", "mesh", "closure", "interpolation"};

}  // namespace

LoadEntry look_up(const LoadTables& tables, const Vector3d& direction, double reynolds_number) noexcept {
    return interpolated(tables, tables.entries, direction, reynolds_number);
}

LoadTables at_reynolds_number(const LoadTables& tables, double reynolds_number) {
    const ReynoldsCell cell = reynolds_cell(tables.reynolds_numbers, reynolds_number);
    const std::size_t plane = tables.index(1, 0, 0);
    const auto cut = [&](const std::vector<LoadEntry>& entries) {
        std::vector<LoadEntry> result(entries.empty() ? 0 : plane);
        for (std::size_t i = 0; i < result.size(); ++i) {
            const std::size_t below = static_cast<std::size_t>(cell.index) * plane + i;
            add_weighted(result[i], entries[below], 1.0 - cell.fraction);
            if (cell.fraction > 0.0) add_weighted(result[i], entries[below + plane], cell.fraction);
        }
        return result;
    };
    LoadTables one = tables;
    one.reynolds_numbers = {
        std::clamp(reynolds_number, tables.reynolds_numbers.front(), tables.reynolds_numbers.back())};
    one.entries = cut(tables.entries);
    one.errors = cut(tables.errors);
    return one;
}

LoadEntryError look_up_error(const LoadTables& tables, const Vector3d& direction,
                             double reynolds_number) noexcept {
    return interpolated(tables, tables.errors, direction, reynolds_number);
}

bool PlannedRegion::holds(const Vector3d& direction) const noexcept {
    if (subdivisions == 0) return true;
    const OctahedralCell cell = octahedral_cell(subdivisions, direction);
    const int row = cell.row + (cell.row_fraction < 0.5 ? 0 : 1);
    const int column = cell.column + (cell.column_fraction < 0.5 ? 0 : 1);
    const std::size_t side = 2 * as_index(subdivisions) + 1;
    return planned[as_index(row) * side + as_index(column)] != 0;
}

const char* name_of(ErrorSource source) {
    return names[static_cast<std::size_t>(source)];
}

std::optional<ErrorSource> error_source(std::string_view name) {
    for (std::size_t i = 0; i < error_source_count; ++i) {
        if (name == names[i]) return static_cast<ErrorSource>(i);
    }
    return std::nullopt;
}

}  // namespace samara
