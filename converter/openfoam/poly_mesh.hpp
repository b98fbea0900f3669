#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "converter/openfoam/foam_file.hpp"
#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// A patch of a mesh's boundary: consecutive faces.
struct FoamPatch {
    std::string name;
    std::string type;  ///< "wall", "patch", ...
    std::size_t start = 0;
    std::size_t size = 0;
};

/// A mesh of OpenFOAM: the content of constant/polyMesh.
struct PolyMesh {
    std::vector<Vector3d> points;
    FoamFaces faces;
    std::vector<std::int64_t> owner;      ///< the cell that owns each face
    std::vector<std::int64_t> neighbour;  ///< the other cell of each of the first (inner) faces
    std::vector<FoamPatch> patches;

    [[nodiscard]] std::size_t cell_count() const;
    /// Returns the places of a face's points.
    [[nodiscard]] std::vector<Vector3d> corners(std::size_t face) const;
};

/// The centre and area vector of a face.
struct FaceGeometry {
    Vector3d center;
    Vector3d area;  ///< area vector, out of the face's owner
};

/// Computes centre and area of a face, cut into triangles about the mean of its corners as in OpenFOAM's
/// primitiveMesh.
FaceGeometry face_geometry(const std::vector<Vector3d>& corners);

/// Reads constant/polyMesh. Throws Error where a file is missing or damaged, and where they are of different
/// meshes.
PolyMesh read_poly_mesh(const std::filesystem::path& poly_mesh);

/// Computes the volumes of some cells of a mesh, in their order, from points, faces, owner and neighbour of
/// constant/polyMesh: the sum of the pyramids from the mean of the cell's face centres to its faces, each
/// face cut into triangles about the mean of its points, as in OpenFOAM's primitiveMesh. For cases without
/// the field V. Throws Error where a file is damaged or a cell is not in the mesh.
std::vector<double> cell_volumes(const std::filesystem::path& poly_mesh,
                                 const std::vector<std::int64_t>& cells);

/// Returns the area of the patches of a mesh (`poly_mesh`: its folder) that match the names or patterns
/// ("body.*"); nothing where the mesh is not complete, has no such patch, or a pattern has another form.
std::optional<double> area_of_patches(const std::filesystem::path& poly_mesh,
                                      const std::vector<std::string>& patches);

}  // namespace samara
