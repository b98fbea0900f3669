#pragma once

#include <memory>
#include <string>

#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/hdf5_writer.hpp"
#include "samara/core/surface/look_mesh.hpp"

namespace samara {

/// Writes a look into a group of a motion file.
void write_look(Hdf5Writer& file, const std::string& group, const LookMesh& look);

/// The look of a group; null where there is none. Throws Error where its numbers are not those of a mesh.
std::shared_ptr<const LookMesh> read_look(const Hdf5Reader& file, const std::string& group);

}  // namespace samara
