#pragma once

#include <filesystem>
#include <vector>

#include "foam-cases/bake/bake.hpp"

namespace samara {

/// What a bake of a scene is asked for.
struct SceneBakeOptions {
    BakeQuality quality;
    Inflow inflow;
    bool whole_grid = false;  ///< all directions, not those that the scene visits
    double tolerance = 0.1;
    std::optional<double> budget;
    int most_rounds = 8;
};

/// One request for each body of a scene, NAME.body.h5 in the folder. A body that asks for neither table loads
/// nor turbulence from tables gets a mesh and a Kirchhoff tensor alone.
std::vector<BakeRequest> requests_for_scene(const Scene& scene, const std::filesystem::path& folder,
                                            const SceneBakeOptions& options);

}  // namespace samara
