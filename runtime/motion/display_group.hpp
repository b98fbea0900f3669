#pragma once

#include <memory>
#include <string>

#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/hdf5_writer.hpp"
#include "samara/core/surface/display_mesh.hpp"

namespace samara {

/// Writes a look into a group of a motion file.
void write_display(Hdf5Writer& file, const std::string& group, const DisplayMesh& display);

/// The look of a group; null where there is none. Throws Error where its numbers are not those of a mesh.
std::shared_ptr<const DisplayMesh> read_display(const Hdf5Reader& file, const std::string& group);

}  // namespace samara
