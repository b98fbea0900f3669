#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "samara/core/wind/wind_grid.hpp"

namespace samara {

/// How OpenVDB files are understood.
struct VdbOptions {
    std::string grid = {};     ///< the velocity's name; empty: velocity, vel or v, or the only one there is
    bool y_up = false;         ///< whether y is up in the files, as in Houdini; else z, as in Blender
    double frame_rate = 24.0;  ///< files a second
    std::optional<double> voxel_size = {};  ///< m: of grids that are in index space
    std::optional<double> spacing = {};     ///< m: between nodes; default: the voxels' of the first file
    std::function<void(double done, double total)> progress = {};  ///< of the files
};

/// The velocities of OpenVDB files, one for each time, on one regular grid that holds all their active
/// voxels. A velocity is a grid of vectors, staggered or not, or three of numbers, NAME.x, NAME.y and NAME.z.
/// Throws Error, naming the file, where it cannot be read, has no velocity or several, is in index space (a
/// voxel of 1 without a place) or holds numbers that are not finite, and where no file has an active voxel.
WindGrid read_vdb_wind(const std::vector<std::filesystem::path>& files, const VdbOptions& options);

}  // namespace samara
