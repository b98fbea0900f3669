#include "samara/body/planned_region.hpp"

#include "internal/body/octahedral_map.hpp"

namespace samara {
bool PlannedRegion::holds(const Vector3d& direction) const noexcept {
    if (subdivisions == 0) return true;
    const OctahedralCell cell = octahedral_cell(subdivisions, direction);
    const int row = cell.row + (cell.row_fraction < 0.5 ? 0 : 1);
    const int column = cell.column + (cell.column_fraction < 0.5 ? 0 : 1);
    return planned[static_cast<std::size_t>(row * (2 * subdivisions + 1) + column)] != 0;
}

}  // namespace samara
