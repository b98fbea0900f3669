#pragma once

#include <filesystem>
#include <functional>

#include "samara/core/surface/surface.hpp"

namespace samara::test {

/// Writes the flat triangles as a text STL file.
void write_stl(const std::filesystem::path& file, const Surface& surface);

/// Writes the flat triangles as a binary STL file.
void write_binary_stl(const std::filesystem::path& file, const Surface& surface);

/// Writes the flat triangles as an OBJ file.
void write_obj(const std::filesystem::path& file, const Surface& surface);

/// Runs `build`, which makes a model by gmsh's C++ interface, and has gmsh write it.
void write_with_gmsh(const std::filesystem::path& file, const std::function<void()>& build);

/// The shape that comes with samara.
std::filesystem::path shape_of_samara(const std::string& name);

/// The shape that is kept for the tests.
std::filesystem::path shape_of_tests(const std::string& name);

}  // namespace samara::test
