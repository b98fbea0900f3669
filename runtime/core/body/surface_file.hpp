#pragma once

#include <string>

#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/hdf5_writer.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// Writes a surface as the datasets vertices (n, 3), corners (triangles, 3) and, for order 2, edge_nodes
/// (triangles, 3) of the group: the same in body files and motion files.
void write_surface(Hdf5Writer& file, const std::string& group, const Surface& surface,
                   const char* units = "m", const char* axes = "shape axes");

/// Reads what write_surface wrote. Throws Error where a value is not finite, an index points outside the
/// vertices, or the lengths do not fit.
Surface read_surface(const Hdf5Reader& file, const std::string& group);

}  // namespace samara
