#pragma once

#include <filesystem>

#include "samara/core/surface/surface.hpp"

namespace samara {

/// The triangles of the objects that a 3MF file has built, each with its components and where it is placed,
/// in metres by the file's unit (lib3mf). Throws Error where lib3mf cannot read it or nothing is built.
Surface read_3mf_file(const std::filesystem::path& file);

}  // namespace samara
