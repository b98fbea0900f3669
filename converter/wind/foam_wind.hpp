#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "samara/core/wind/wind_grid.hpp"

namespace samara {

/// How a solved case of OpenFOAM is taken as a wind.
struct FoamWindOptions {
    double spacing = 0.0;                         ///< m between nodes
    std::optional<Eigen::AlignedBox3d> box = {};  ///< m, z up: where nodes are; default: around the mesh
    bool y_up = false;                            ///< whether y is up in the case; else z
    bool latest = false;                          ///< the last time alone, as a steady wind
    std::function<void(double done, double total)> progress = {};  ///< of the times
};

/// The velocity U of a solved case (constant/polyMesh, reconstructed) at the nodes of a regular grid, at the
/// times that were written, the first of which becomes 0. In a cell it is linear, with the least-squares
/// gradient of the cells around, and no larger or smaller than in these (Barth and Jespersen, AIAA 89-0366,
/// 1989); outside of the mesh, in walls and bodies, it is zero. Throws Error, naming the file, where there is
/// no mesh, no time with a U, where times are not evenly apart, and where a file is damaged.
WindGrid read_foam_wind(const std::filesystem::path& case_folder, const FoamWindOptions& options);

}  // namespace samara
