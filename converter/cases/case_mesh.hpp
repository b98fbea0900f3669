#pragma once

#include <filesystem>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "converter/openfoam/poly_mesh.hpp"

namespace samara {

/// The resolution of the flow at the body in a solved case: y+ at the centres of the cells along its patches,
/// weighted by the area of their faces.
struct WallSpacing {
    bool wall_functions =
        false;  ///< whether wall functions of k are used; else the cells are to resolve the boundary layer
    double least = 0.0;
    double mean = 0.0;
    double median = 0.0;
    double most = 0.0;
    double below_30 = 0.0;  ///< share of the area: below the logarithmic layer, in which wall functions hold
    double above_1 = 0.0;   ///< share of the area
};

/// Computes the wall spacing from the last written fields of a solved case on its mesh. With wall functions
/// y+ = Cmu^(1/4) sqrt(k) y/nu with Cmu = 0.09, else y sqrt(|U_t|/(y nu)), with y normal to the face and the
/// tangential velocity U_t: as OpenFOAM's yPlus does. For cases of `samara bake` (nu = 1/Re by the file
/// `parameters`). Throws Error where a file is missing or damaged, or fields and mesh do not belong together.
WallSpacing wall_spacing(const std::filesystem::path& case_folder, const PolyMesh& mesh);

/// The section of a mesh by a plane: straight pieces in the plane's coordinates.
struct MeshSection {
    using Piece = std::pair<Eigen::Vector2d, Eigen::Vector2d>;
    std::vector<Piece> cells;  ///< of faces between cells
    std::vector<Piece> body;   ///< of the body's surface
};

/// Returns the pieces of the section that reach into the rectangle |x| < `half_width`, |y| < `half_height` of
/// the plane spanned by the unit vectors `right` and `up`, at the distance `off` from the origin along right
/// x up.
MeshSection mesh_section(const PolyMesh& mesh, const Vector3d& right, const Vector3d& up, double off,
                         double half_width, double half_height);

}  // namespace samara
