#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "samara/core/body/body.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// Returns whether the file begins as HDF5 files do; false also where it cannot be read or is a pipe.
bool is_hdf5(const std::filesystem::path& file);

/// How a shape file becomes a body; a body file takes the defaults alone.
struct ShapeReading {
    double scale = 1.0;      ///< m: the length of one unit of the file
    double thickness = 0.0;  ///< m: what an open sheet is thickened to; 0: the shape is a solid
    int triangles = 0;       ///< how many the mesh is to have; 0: samara-mesh's own choice

    /// Compares member by member.
    bool operator==(const ShapeReading&) const = default;
};

inline constexpr const char* thickness_help =
    "thickens an open sheet of triangles, which is taken as its middle, to this (m)";

/// Returns how a scene's shape file is read.
ShapeReading reading_of(const SceneBody& body);
/// Returns the options of samara-mesh for it.
std::vector<std::string> words_of(const ShapeReading& reading);

/// Returns the body of a body file, or of any shape file (.geo .stl .obj .step), which the program
/// samara-mesh meshes. Throws Error where the file cannot be read or meshed, where samara-mesh is not
/// installed, and where other than the defaults is asked of a body file.
Body load_body(const std::filesystem::path& body_or_shape, const ShapeReading& reading = {});

}  // namespace samara
