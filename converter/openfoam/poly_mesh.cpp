#include "converter/openfoam/poly_mesh.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "converter/openfoam/foam_file.hpp"
#include "converter/openfoam/foam_scanner.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

/// Reads the file boundary.
std::vector<FoamPatch> read_patches(const std::filesystem::path& file) {
    FoamScanner scanner(file);
    if (scanner.word() != "FoamFile") throw scanner.error("is not an OpenFOAM file");
    scanner.expect('{');
    scanner.text_before('}');
    const std::int64_t count = scanner.integer();
    scanner.expect('(');
    std::vector<FoamPatch> patches;
    while (!scanner.accept(')')) {
        FoamPatch patch{.name = std::string(scanner.word()), .type = {}};
        scanner.expect('{');
        while (!scanner.accept('}')) {
            const std::string key(scanner.word());
            if (key == "nFaces" || key == "startFace") {
                const std::int64_t number = scanner.integer();
                if (number < 0) throw scanner.error("a number of faces is negative");
                (key == "nFaces" ? patch.size : patch.start) = static_cast<std::size_t>(number);
                scanner.expect(';');
            } else if (key == "type") {
                patch.type = scanner.text_before(';');
            } else {
                scanner.text_before(';');
            }
        }
        patches.push_back(std::move(patch));
    }
    if (static_cast<std::int64_t>(patches.size()) != count) {
        throw scanner.error(fmt::format("holds {} patches, but says {}", patches.size(), count));
    }
    return patches;
}

bool is_within(const std::vector<std::int64_t>& numbers, std::size_t count) {
    return std::ranges::all_of(numbers, [&](std::int64_t number) {
        return number >= 0 && static_cast<std::size_t>(number) < count;
    });
}

}  // namespace

std::size_t PolyMesh::cell_count() const {
    return owner.empty() ? 0 : static_cast<std::size_t>(*std::ranges::max_element(owner)) + 1;
}

std::vector<Vector3d> PolyMesh::corners(std::size_t face) const {
    std::vector<Vector3d> places;
    for (std::int64_t i = faces.starts[face]; i < faces.starts[face + 1]; ++i) {
        places.push_back(points[static_cast<std::size_t>(faces.points[static_cast<std::size_t>(i)])]);
    }
    return places;
}

FaceGeometry face_geometry(const std::vector<Vector3d>& corners) {
    Vector3d middle = Vector3d::Zero();
    for (const Vector3d& corner : corners) middle += corner;
    middle /= static_cast<double>(corners.size());
    Vector3d area = Vector3d::Zero();
    Vector3d weighted = Vector3d::Zero();
    double weight = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector3d& next = corners[(i + 1) % corners.size()];
        const Vector3d triangle = 0.5 * (next - corners[i]).cross(middle - corners[i]);
        area += triangle;
        weighted += triangle.norm() * (corners[i] + next + middle) / 3.0;
        weight += triangle.norm();
    }
    return {weight > 0.0 ? Vector3d(weighted / weight) : middle, area};
}

PolyMesh read_poly_mesh(const std::filesystem::path& poly_mesh) {
    PolyMesh mesh{read_points(poly_mesh / "points"), read_faces(poly_mesh / "faces"),
                  read_labels(poly_mesh / "owner"), read_labels(poly_mesh / "neighbour"),
                  read_patches(poly_mesh / "boundary")};
    const bool sound =
        mesh.owner.size() == mesh.faces.size() && mesh.neighbour.size() <= mesh.faces.size() &&
        is_within(mesh.faces.points, mesh.points.size()) && is_within(mesh.owner, mesh.faces.size()) &&
        is_within(mesh.neighbour, mesh.cell_count()) &&
        std::ranges::all_of(mesh.patches, [&](const FoamPatch& patch) {
            return patch.start <= mesh.faces.size() && patch.size <= mesh.faces.size() - patch.start;
        });
    if (sound) return mesh;
    throw Error(fmt::format(
        "{}: points, faces, owner, neighbour and boundary belong to different meshes; copy the folder again",
        poly_mesh.string()));
}

namespace {

/// A face of a cell.
struct CellFace {
    std::size_t cell;  ///< index among the requested cells
    FaceGeometry geometry;
};

/// Returns for each cell of the mesh its index among the requested cells, or -1.
std::vector<std::int64_t> places_of(const std::vector<std::int64_t>& cells, std::int64_t mesh_cells,
                                    const std::filesystem::path& poly_mesh) {
    std::vector<std::int64_t> places(static_cast<std::size_t>(mesh_cells), -1);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (cells[i] < 0 || cells[i] >= mesh_cells) {
            throw Error(
                fmt::format("{}: the mesh has no cell {}, which its zone contains; mesh and zone do not "
                            "match; copy the folder again",
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
            fmt::format("{}: owner, neighbour and faces belong to different meshes; copy the folder again",
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
    const auto add_face = [&](std::int64_t place, const FaceGeometry& geometry) {
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
        if (inside >= 0) add_face(inside, geometry);
        if (outside >= 0) add_face(outside, {geometry.center, -geometry.area});
    }

    std::vector<double> volumes(cells.size(), 0.0);
    for (const CellFace& face : seen) {
        const Vector3d middle = middles[face.cell] / counts[face.cell];
        volumes[face.cell] += face.geometry.area.dot(face.geometry.center - middle) / 3.0;
    }
    return volumes;
}

namespace {

bool is_word(const std::string& name) {
    return name.find_first_of("*+?[]{}|^$\\\\()") == std::string::npos;
}

}  // namespace

std::optional<double> area_of_patches(const std::filesystem::path& poly_mesh,
                                      const std::vector<std::string>& patches) {
    for (const char* name : {"points", "faces", "owner", "neighbour", "boundary"}) {
        if (!foam_file_exists(poly_mesh / name)) return std::nullopt;
    }
    const PolyMesh mesh = read_poly_mesh(poly_mesh);
    double area = 0.0;
    for (const std::string& pattern : patches) {
        const bool is_start = pattern.ends_with(".*");
        const std::string start = is_start ? pattern.substr(0, pattern.size() - 2) : pattern;
        if (!is_word(start)) return std::nullopt;
        for (const FoamPatch& patch : mesh.patches) {
            if (is_start ? !patch.name.starts_with(start) : patch.name != start) continue;
            for (std::size_t i = 0; i < patch.size; ++i) {
                area += face_geometry(mesh.corners(patch.start + i)).area.norm();
            }
        }
    }
    return area > 0.0 ? std::optional(area) : std::nullopt;
}

}  // namespace samara
