#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "samara/core/wind/wind_grid.hpp"

namespace samara {

/// How a solved case of OpenFOAM is read as a wind.
struct FoamWindOptions {
    double spacing = 0.0;  ///< m between nodes
    std::optional<Eigen::AlignedBox3d> box =
        {};               ///< m, z up: the region of the nodes; default: around the mesh
    bool y_up = false;    ///< whether the y axis is up in the case, else z
    bool latest = false;  ///< only the last time, as a steady wind
    std::function<void(double done, double total)> progress = {};  ///< of the times
};

/// Reads the velocity U of a solved case (constant/polyMesh, reconstructed) at the nodes of a regular grid
/// and the written times, the first of which becomes 0. In a cell it is linear with the least-squares
/// gradient over the neighbouring cells, limited to the range of their values (Barth and Jespersen, AIAA
/// 89-0366, 1989); outside of the mesh, in walls and bodies, it is zero. Throws Error, naming the file, where
/// there is no mesh, no time with a U, where times are not evenly apart, and where a file is damaged.
WindGrid read_foam_wind(const std::filesystem::path& case_folder, const FoamWindOptions& options);

/// How OpenVDB files are read.
struct VdbOptions {
    std::string grid =
        {};             ///< name of the velocity grid; empty: velocity, vel or v, or the only grid of vectors
    bool y_up = false;  ///< whether the y axis is up in the files, as in Houdini, else z, as in Blender
    double frame_rate = 24.0;               ///< files a second
    std::optional<double> voxel_size = {};  ///< m, for grids in index space
    std::optional<double> spacing = {};     ///< m between nodes; default: the voxel size of the first file
    std::function<void(double done, double total)> progress = {};  ///< of the files
};

/// Reads the velocities of OpenVDB files, one for each time, on one regular grid that contains all their
/// active voxels. A velocity is a grid of vectors, staggered or not, or three of numbers, NAME.x, NAME.y and
/// NAME.z. Throws Error, naming the file, where it cannot be read, has no velocity or several, is in index
/// space (a voxel of 1 without a place) or holds numbers that are not finite, and where no file has an active
/// voxel.
WindGrid read_vdb_wind(const std::vector<std::filesystem::path>& files, const VdbOptions& options);

/// Sets origin and numbers of nodes of a grid so that it covers a box (m) with its spacing. Throws Error
/// where they would be too many over all its frames.
void lay_nodes(WindGrid& grid, const Eigen::AlignedBox3d& box);

}  // namespace samara
