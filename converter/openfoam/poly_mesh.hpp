#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "converter/openfoam/foam_file.hpp"
#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// A part of a mesh's boundary: faces in a row.
struct FoamPatch {
    std::string name;
    std::string type;  ///< "wall", "patch", ...
    std::size_t start = 0;
    std::size_t size = 0;
};

/// A mesh of OpenFOAM: constant/polyMesh, whole.
struct PolyMesh {
    std::vector<Vector3d> points;
    FoamFaces faces;
    std::vector<std::int64_t> owner;      ///< the cell of each face
    std::vector<std::int64_t> neighbour;  ///< the other cell of each of the first faces
    std::vector<FoamPatch> patches;

    [[nodiscard]] std::size_t cell_count() const;
    /// The places of a face's points.
    [[nodiscard]] std::vector<Vector3d> corners(std::size_t face) const;
};

/// Where a face is and which way it looks.
struct FaceGeometry {
    Vector3d center;
    Vector3d area;  ///< out of the face's owner
};

/// A face cut into triangles about the mean of its corners, as in OpenFOAM's primitiveMesh.
FaceGeometry face_geometry(const std::vector<Vector3d>& corners);

/// Reads constant/polyMesh. Throws Error where a file is missing or damaged, and where they are of different
/// meshes.
PolyMesh read_poly_mesh(const std::filesystem::path& poly_mesh);

/// The volumes of some cells of a mesh, in their order, from points, faces, owner and neighbour of
/// constant/polyMesh: the sum of the pyramids from the mean of the cell's face centres to its faces, each
/// face cut into triangles about the mean of its points, as in OpenFOAM's primitiveMesh. For cases without
/// the field V. Throws Error where a file is damaged or a cell is not in the mesh.
std::vector<double> cell_volumes(const std::filesystem::path& poly_mesh,
                                 const std::vector<std::int64_t>& cells);

/// The area of the patches of FOLDER/constant/polyMesh that the names or patterns ("body.*") take in; nothing
/// where there is no whole mesh, no such patch, or a pattern of another kind.
std::optional<double> area_of_patches(const std::filesystem::path& poly_mesh,
                                      const std::vector<std::string>& patches);

}  // namespace samara
