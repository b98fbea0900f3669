#pragma once

#include <memory>
#include <string>
#include <vector>

#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/hdf5_writer.hpp"
#include "samara/core/physics/obstacle.hpp"
#include "samara/core/surface/display_mesh.hpp"

namespace samara {

/// Writes a display mesh into a group of a motion file.
void write_display(Hdf5Writer& file, const std::string& group, const DisplayMesh& display);

/// Reads the display mesh of a group; null where there is none. Throws Error where its numbers are not those
/// of a mesh.
std::shared_ptr<const DisplayMesh> read_display(const Hdf5Reader& file, const std::string& group);

/// Writes obstacles as the groups /obstacles/NAME: surface, friction, and keys (n, 8) of time, position and
/// orientation. Writes nothing where there are none.
void write_obstacles(Hdf5Writer& file, const std::vector<Obstacle>& obstacles);

/// Reads the obstacles that write_obstacles() wrote, in their order. Throws Error where a value is invalid.
std::vector<Obstacle> read_obstacles(const Hdf5Reader& file);

}  // namespace samara
