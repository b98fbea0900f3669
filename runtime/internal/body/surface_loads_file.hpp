#pragma once

#include <string>

#include "internal/files/hdf5_reader.hpp"
#include "internal/files/hdf5_writer.hpp"
#include "samara/body/surface_loads.hpp"

namespace samara {

/// Writes the group /surface_loads of a body file (docs/file-formats.md).
void write_surface_loads(Hdf5Writer& file, const SurfaceLoads& loads);

/// Reads it. Throws Error where its map has no sane size or its numbers are no coefficients.
SurfaceLoads read_surface_loads(const Hdf5Reader& file);

}  // namespace samara
