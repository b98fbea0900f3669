#pragma once

#include <vector>

#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/hdf5_writer.hpp"
#include "samara/core/physics/obstacle.hpp"

namespace samara {

/// Writes obstacles as the groups /obstacles/NAME: surface, friction, and keys (n, 8) of time, position and
/// orientation. Writes nothing where there are none.
void write_obstacles(Hdf5Writer& file, const std::vector<Obstacle>& obstacles);

/// Reads what write_obstacles wrote, in its order. Throws Error where a value is none that an obstacle has.
std::vector<Obstacle> read_obstacles(const Hdf5Reader& file);

}  // namespace samara
