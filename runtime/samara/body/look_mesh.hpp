#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "samara/base/linear_algebra.hpp"

namespace samara {

/// A material slot of a mesh.
struct LookMaterial {
    std::string name;
    std::array<double, 4> color = {0.8, 0.8, 0.8, 1.0};  ///< red, green, blue and opacity, 0 to 1, linear
};

/// A mesh that exports show in place of a body's surface: with what a picture needs of it, and as its file
/// has it, holes and all.
struct LookMesh {
    std::vector<Vector3d> positions;       ///< m, shape axes
    std::vector<Vector3d> normals;         ///< of length one, one for each position; or none
    std::vector<Eigen::Vector2d> texture;  ///< u to the right and v upwards, one for each position; or none
    std::vector<std::array<std::int32_t, 3>> corners;  ///< triangles, counter-clockwise from outside
    std::vector<std::int32_t> slots;                   ///< of each triangle the number of its material
    std::vector<LookMaterial> materials;               ///< one at least
};

}  // namespace samara
