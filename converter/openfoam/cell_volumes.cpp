#include "converter/openfoam/cell_volumes.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "converter/openfoam/foam_file.hpp"
#include "converter/openfoam/poly_mesh.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

/// One face as a cell sees it.
struct CellFace {
    std::size_t cell;  ///< its place among the cells asked for
    FaceGeometry geometry;
};

/// For each cell of the mesh its place among the cells asked for, or -1.
std::vector<std::int64_t> places_of(const std::vector<std::int64_t>& cells, std::int64_t mesh_cells,
                                    const std::filesystem::path& poly_mesh) {
    std::vector<std::int64_t> places(static_cast<std::size_t>(mesh_cells), -1);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells[i] < 0 || cells[i] >= mesh_cells) {
            throw Error(
                fmt::format("{}: the mesh has no cell {}, which its zone names; mesh and zone do not "
                            "belong together",
                            poly_mesh.string(), cells[i]));
        }
        places[static_cast<std::size_t>(cells[i])] = static_cast<std::int64_t>(i);
    }
    return places;
}

std::vector<Vector3d> corners_of(const FoamFaces& faces, std::size_t face,
                                 const std::vector<Vector3d>& points,
                                 const std::filesystem::path& poly_mesh) {
    std::vector<Vector3d> corners;
    for (std::int64_t i = faces.starts[face]; i < faces.starts[face + 1]; ++i) {
        const std::int64_t point = faces.points[static_cast<std::size_t>(i)];
        if (point < 0 || point >= static_cast<std::int64_t>(points.size())) {
            throw Error(fmt::format("{}: face {} has the point {}, but there are {}",
                                    (poly_mesh / "faces").string(), face, point, points.size()));
        }
        corners.push_back(points[static_cast<std::size_t>(point)]);
    }
    return corners;
}

}  // namespace

std::vector<double> cell_volumes(const std::filesystem::path& poly_mesh,
                                 const std::vector<std::int64_t>& cells) {
    const std::vector<std::int64_t> owner = read_labels(poly_mesh / "owner");
    const std::vector<std::int64_t> neighbour = read_labels(poly_mesh / "neighbour");
    const FoamFaces faces = read_faces(poly_mesh / "faces");
    const std::vector<Vector3d> points = read_points(poly_mesh / "points");
    if (owner.size() != faces.size() || neighbour.size() > faces.size()) {
        throw Error(
            fmt::format("{}: owner, neighbour and faces are of different meshes; copy the folder again",
                        poly_mesh.string()));
    }
    const std::int64_t last = owner.empty() ? -1 : *std::max_element(owner.begin(), owner.end());
    const std::vector<std::int64_t> places = places_of(cells, last + 1, poly_mesh);
    const auto place_of = [&](std::int64_t cell) {
        return cell >= 0 && cell <= last ? places[static_cast<std::size_t>(cell)] : -1;
    };

    std::vector<CellFace> seen;
    std::vector<Vector3d> middles(cells.size(), Vector3d::Zero());
    std::vector<int> counts(cells.size(), 0);
    const auto see = [&](std::int64_t place, const FaceGeometry& geometry) {
        const auto cell = static_cast<std::size_t>(place);
        seen.push_back({cell, geometry});
        middles[cell] += geometry.center;
        ++counts[cell];
    };
    for (std::size_t face = 0; face < faces.size(); ++face) {
        const std::int64_t inside = place_of(owner[face]);
        const std::int64_t outside = face < neighbour.size() ? place_of(neighbour[face]) : -1;
        if (inside < 0 && outside < 0) continue;
        const FaceGeometry geometry = face_geometry(corners_of(faces, face, points, poly_mesh));
        if (inside >= 0) see(inside, geometry);
        if (outside >= 0) see(outside, {geometry.center, -geometry.area});
    }

    std::vector<double> volumes(cells.size(), 0.0);
    for (const CellFace& face : seen) {
        const Vector3d middle = middles[face.cell] / counts[face.cell];
        volumes[face.cell] += face.geometry.area.dot(face.geometry.center - middle) / 3.0;
    }
    return volumes;
}

}  // namespace samara
