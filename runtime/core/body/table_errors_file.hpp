#pragma once

#include "samara/core/body/load_tables.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/hdf5_writer.hpp"

namespace samara {

/// Writes /tables/error_sources and /tables/left_out of a body file, where the tables have any.
void write_table_errors(Hdf5Writer& file, const LoadTables& tables);

/// Reads them into the tables; files without them leave both empty. Throws Error where a source is unknown
/// or a value breaks a rule.
void read_table_errors(const Hdf5Reader& file, LoadTables& tables);

}  // namespace samara
