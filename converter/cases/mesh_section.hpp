#pragma once

#include <utility>
#include <vector>

#include <Eigen/Core>

#include "converter/openfoam/poly_mesh.hpp"

namespace samara {

/// A mesh where a plane cuts it: straight pieces, in the plane's coordinates.
struct MeshSection {
    using Piece = std::pair<Eigen::Vector2d, Eigen::Vector2d>;
    std::vector<Piece> cells;  ///< of faces between cells
    std::vector<Piece> body;   ///< of the body's surface
};

/// The pieces that reach into the rectangle |x| < `half_width`, |y| < `half_height` of the plane spanned by
/// the unit vectors `right` and `up`, `off` the origin along right x up.
MeshSection mesh_section(const PolyMesh& mesh, const Vector3d& right, const Vector3d& up, double off,
                         double half_width, double half_height);

}  // namespace samara
