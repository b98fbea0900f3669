#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace samara {

/// The volumes of some cells of a mesh, in their order, from points, faces, owner and neighbour of
/// constant/polyMesh: the sum of the pyramids from the mean of the cell's face centres to its faces, each
/// face cut into triangles about the mean of its points, as in OpenFOAM's primitiveMesh. For cases without
/// the field V. Throws Error where a file is damaged or a cell is not in the mesh.
std::vector<double> cell_volumes(const std::filesystem::path& poly_mesh,
                                 const std::vector<std::int64_t>& cells);

}  // namespace samara
