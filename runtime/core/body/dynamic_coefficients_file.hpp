#pragma once

#include "samara/core/body/dynamic_coefficients.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/hdf5_writer.hpp"

namespace samara {

/// Writes the coefficients and their standard errors as the group /dynamic_coefficients
/// (docs/file-formats).
void write_dynamic_coefficients(Hdf5Writer& file, const IdentifiedCoefficients& coefficients);

/// Reads what write_dynamic_coefficients wrote. Throws Error, naming file and place, where a number is not
/// finite, a tensor is not symmetric and positive semidefinite, the half-length is not positive or a standard
/// error is negative.
IdentifiedCoefficients read_dynamic_coefficients(const Hdf5Reader& file);

}  // namespace samara
