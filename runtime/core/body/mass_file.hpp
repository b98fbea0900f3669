#pragma once

#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/hdf5_writer.hpp"
#include "samara/core/physics/mass_specification.hpp"

namespace samara {

/// Writes the group /mass of a body file (docs/file-formats.md).
void write_mass(Hdf5Writer& file, const MassSpecification& mass);

/// Reads it. Throws Error where it holds both a density and a mass, or neither.
MassSpecification read_mass(const Hdf5Reader& file);

}  // namespace samara
