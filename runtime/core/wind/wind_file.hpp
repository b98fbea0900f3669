#pragma once

#include <filesystem>

#include "samara/core/wind/wind_grid.hpp"

namespace samara {

/// Reads a wind file (docs/file-formats). Throws Error, naming the file and the place in it, where it is
/// missing, cut short, damaged, of another type or from a newer version, and where its content breaks a rule:
/// a node, a time, a positive spacing and interval, finite velocities.
WindGrid read_wind_file(const std::filesystem::path& file);

/// Writes a wind file whole, through a temporary file: equal grids give equal bytes. Throws Error.
void write_wind_file(const std::filesystem::path& file, const WindGrid& grid);

}  // namespace samara
