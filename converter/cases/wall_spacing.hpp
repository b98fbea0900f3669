#pragma once

#include <filesystem>

#include "converter/openfoam/poly_mesh.hpp"

namespace samara {

/// How a solved case resolves the flow at the body: y+ of the middles of the cells along its patches, of
/// which each face counts by its area.
struct WallSpacing {
    bool wall_functions = false;  ///< of k; else the cells are to resolve the boundary layer
    double least = 0.0;
    double median = 0.0;
    double most = 0.0;
    double below_30 = 0.0;  ///< share of the area: below the logarithmic layer, in which wall functions hold
    double above_1 = 0.0;   ///< share of the area
};

/// The spacing in the last written fields of a solved case on its mesh. With wall functions y+ = Cmu^(1/4)
/// sqrt(k) y/nu with Cmu = 0.09, else y sqrt(|U_t|/(y nu)), with y normal to the face and the tangential
/// velocity U_t: as OpenFOAM's yPlus has them. Of a case of `samara bake` (nu = 1/Re by its file
/// `parameters`). Throws Error where a file is missing or damaged, or fields and mesh do not belong together.
WallSpacing wall_spacing(const std::filesystem::path& case_folder, const PolyMesh& mesh);

}  // namespace samara
