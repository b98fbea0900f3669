#pragma once

#include <filesystem>
#include <vector>

#include "converter/openfoam/foam_history.hpp"
#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// A vector at every iteration.
struct VectorHistory {
    HistoryFiles files;
    std::vector<double> times;  ///< ascending
    std::vector<Vector3d> values;
};

/// What the function object `forces` wrote: the whole force and moment, of pressure and friction (and porous
/// zones), in the case's units.
struct LoadHistory {
    VectorHistory force;
    VectorHistory moment;
};

/// Reads postProcessing/forces over all runs (read_joined_history): force.dat and moment.dat of OpenFOAM
/// .com, or forces.dat of .org, whose parts are added up. Throws Error where neither is there, or one is
/// damaged.
LoadHistory read_load_history(const std::filesystem::path& folder);

}  // namespace samara
