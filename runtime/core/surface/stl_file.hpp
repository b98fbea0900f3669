#pragma once

#include <filesystem>
#include <string>

#include "samara/core/surface/surface.hpp"

namespace samara {

/// Returns the triangles of an STL file, text or binary, each with three vertices of its own; the normals in
/// the file are not used. Throws Error, which names the line or the byte count, where the file is cut short
/// or is no STL file.
Surface read_stl_file(const std::filesystem::path& file);

/// Returns the triangles of the bytes of an STL file as read_stl_file() does; `label` stands for its name in
/// errors.
Surface read_stl(const std::string& bytes, const std::string& label);

}  // namespace samara
