#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "samara/core/surface/surface.hpp"

namespace samara {

/// The `count` surfaces that `read` gives, called in a process of its own that can do nothing but compute and
/// read files beneath the shape's folder (run_confined): gmsh's files may be programs, and its readers were
/// not written for damaged ones. `time_limit`: seconds of computing. Indices of the results are within their
/// vertices. Throws Error, one line that names the shape. `progress`: called here with the shares that `read`
/// tells.
std::vector<Surface> confined_surfaces(
    const std::filesystem::path& shape, std::size_t count, double time_limit,
    const std::function<std::vector<Surface>(const std::function<void(double)>& progress)>& read,
    const std::function<void(double)>& progress = {});

/// confined_surfaces() of one.
Surface confined_surface(const std::filesystem::path& shape, double time_limit,
                         const std::function<Surface(const std::function<void(double)>& progress)>& read,
                         const std::function<void(double)>& progress = {});

}  // namespace samara
