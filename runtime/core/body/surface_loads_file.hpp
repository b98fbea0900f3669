#pragma once

#include "samara/core/body/surface_loads.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/hdf5_writer.hpp"

namespace samara {

/// Writes the group /surface_loads of a body file (docs/file-formats.md).
void write_surface_loads(Hdf5Writer& file, const SurfaceLoads& loads);

/// Whether the file holds it; an earlier form, of forces by direction, counts as none.
bool has_surface_loads(const Hdf5Reader& file);

/// Reads it. Throws Error where it is no surface, or has lengths or potentials that none has.
SurfaceLoads read_surface_loads(const Hdf5Reader& file);

}  // namespace samara
