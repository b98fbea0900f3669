#pragma once

#include "samara/core/body/planned_region.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/hdf5_writer.hpp"

namespace samara {

/// Writes /tables/planned and /tables/plan (docs/file-formats) where the region is not all directions.
void write_planned_region(Hdf5Writer& file, const PlannedRegion& region);

/// Reads them; all directions where they are absent. Throws Error where the map is of no sane size.
PlannedRegion read_planned_region(const Hdf5Reader& file);

}  // namespace samara
