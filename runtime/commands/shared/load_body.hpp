#pragma once

#include <filesystem>

#include "samara/core/body/body.hpp"

namespace samara {

/// Returns whether the file begins as HDF5 files do; false also where it cannot be read or is a pipe.
bool is_hdf5(const std::filesystem::path& file);

/// Returns the body of a body file, or of any shape file (.geo .stl .obj .step), which the program
/// samara-mesh meshes: `scale` is the length of one unit of the shape file in metres, `triangles` how many
/// the mesh is to have (0: samara-mesh's own choice). Throws Error where the file cannot be read or meshed,
/// where samara-mesh is not installed, and where a scale other than 1 or a number of triangles is asked of a
/// body file.
Body load_body(const std::filesystem::path& body_or_shape, double scale, int triangles = 0);

}  // namespace samara
