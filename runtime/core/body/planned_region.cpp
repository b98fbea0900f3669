#include "samara/core/body/planned_region.hpp"

#include "samara/core/base/as_index.hpp"
#include "samara/core/surface/octahedral_map.hpp"

namespace samara {

bool PlannedRegion::holds(const Vector3d& direction) const noexcept {
    if (subdivisions == 0) return true;
    const OctahedralCell cell = octahedral_cell(subdivisions, direction);
    const int row = cell.row + (cell.row_fraction < 0.5 ? 0 : 1);
    const int column = cell.column + (cell.column_fraction < 0.5 ? 0 : 1);
    const std::size_t side = 2 * as_index(subdivisions) + 1;
    return planned[as_index(row) * side + as_index(column)] != 0;
}

}  // namespace samara
