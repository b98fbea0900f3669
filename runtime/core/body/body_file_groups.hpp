#pragma once

#include "samara/core/body/dynamic_coefficients.hpp"
#include "samara/core/body/load_tables.hpp"
#include "samara/core/body/planned_region.hpp"
#include "samara/core/body/recommended_models.hpp"
#include "samara/core/body/surface_loads.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/hdf5_writer.hpp"
#include "samara/core/physics/mass_specification.hpp"

namespace samara {

/// Writes the coefficients and their standard errors as the group /dynamic_coefficients
/// (docs/file-formats).
void write_dynamic_coefficients(Hdf5Writer& file, const IdentifiedCoefficients& coefficients);

/// Reads what write_dynamic_coefficients wrote. Throws Error, naming file and place, where a number is not
/// finite, a tensor is not symmetric and positive semidefinite, the half-length is not positive or a standard
/// error is negative.
IdentifiedCoefficients read_dynamic_coefficients(const Hdf5Reader& file);

/// Writes the group /mass of a body file (docs/reference/file-formats.md).
void write_mass(Hdf5Writer& file, const MassSpecification& mass);

/// Reads the group /mass of a body file. Throws Error where it holds both a density and a mass, or neither.
MassSpecification read_mass(const Hdf5Reader& file);

/// Writes the group /recommended of a body file (docs/reference/file-formats.md).
void write_recommended_models(Hdf5Writer& file, const RecommendedModels& models);

/// Reads the group /recommended. Throws Error where it names loads or turbulence that no body can have.
RecommendedModels read_recommended_models(const Hdf5Reader& file);

/// Writes /tables/planned and /tables/plan (docs/file-formats) where the region does not cover all
/// directions.
void write_planned_region(Hdf5Writer& file, const PlannedRegion& region);

/// Reads /tables/planned and /tables/plan; the region covers all directions where they are absent. Throws
/// Error where the size of the map is invalid.
PlannedRegion read_planned_region(const Hdf5Reader& file);

/// Writes the group /surface_loads of a body file (docs/reference/file-formats.md).
void write_surface_loads(Hdf5Writer& file, const SurfaceLoads& loads);

/// Returns whether the file holds /surface_loads; an earlier form, of forces by direction, counts as none.
bool has_surface_loads(const Hdf5Reader& file);

/// Reads the group /surface_loads. Throws Error where it is no surface, or its lengths or potentials are
/// impossible.
SurfaceLoads read_surface_loads(const Hdf5Reader& file);

/// Writes /tables/error_sources and /tables/left_out of a body file, where the tables have any.
void write_table_errors(Hdf5Writer& file, const LoadTables& tables);

/// Reads /tables/error_sources and /tables/left_out into the tables; both stay empty where the file lacks
/// them. Throws Error where a source is unknown or a value breaks a rule.
void read_table_errors(const Hdf5Reader& file, LoadTables& tables);

}  // namespace samara
