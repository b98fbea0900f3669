#include "converter/cases/case_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "converter/cases/turbulence_means.hpp"
#include "converter/openfoam/foam_dictionary.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

constexpr double c_mu = 0.09;

/// A face of the body: its cell, its area, and the distance of the cell's centre.
struct WallFace {
    std::size_t cell;
    double area;
    double distance;
    Vector3d normal;  // unit vector
};

bool is_of_body(const FoamPatch& patch) {
    return patch.name.starts_with("body");
}

std::vector<WallFace> wall_faces(const PolyMesh& mesh) {
    std::vector<Vector3d> middles(mesh.cell_count(), Vector3d::Zero());
    std::vector<int> counts(middles.size(), 0);
    std::vector<char> at_wall(middles.size(), 0);
    for (const FoamPatch& patch : mesh.patches) {
        for (std::size_t i = 0; is_of_body(patch) && i < patch.size; ++i) {
            at_wall[static_cast<std::size_t>(mesh.owner[patch.start + i])] = 1;
        }
    }
    const auto see = [&](std::size_t face, std::int64_t cell_number) {
        const auto cell = static_cast<std::size_t>(cell_number);
        if (at_wall[cell] == 0) return;
        middles[cell] += face_geometry(mesh.corners(face)).center;
        ++counts[cell];
    };
    for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
        see(face, mesh.owner[face]);
        if (face < mesh.neighbour.size()) see(face, mesh.neighbour[face]);
    }
    std::vector<WallFace> faces;
    for (const FoamPatch& patch : mesh.patches) {
        for (std::size_t i = 0; is_of_body(patch) && i < patch.size; ++i) {
            const auto cell = static_cast<std::size_t>(mesh.owner[patch.start + i]);
            const FaceGeometry geometry = face_geometry(mesh.corners(patch.start + i));
            const double area = geometry.area.norm();
            if (!(area > 0.0)) continue;
            const Vector3d normal = geometry.area / area;
            faces.push_back(
                {cell, area, std::abs(normal.dot(geometry.center - middles[cell] / counts[cell])), normal});
        }
    }
    return faces;
}

struct SpacedArea {
    double y_plus;
    double area;
};

WallSpacing spacing_of(std::vector<SpacedArea> parts, bool wall_functions) {
    std::ranges::sort(parts, {}, &SpacedArea::y_plus);
    double all = 0.0;
    for (const SpacedArea& part : parts) all += part.area;
    WallSpacing spacing{
        .wall_functions = wall_functions, .least = parts.front().y_plus, .most = parts.back().y_plus};
    double passed = 0.0;
    for (const SpacedArea& part : parts) {
        if (passed < 0.5 * all) spacing.median = part.y_plus;
        passed += part.area;
        spacing.mean += part.y_plus * part.area / all;
        if (part.y_plus < 30.0) spacing.below_30 += part.area / all;
        if (part.y_plus > 1.0) spacing.above_1 += part.area / all;
    }
    return spacing;
}

/// Returns the folder of the last fields. Throws Error where they are not reconstructed.
fs::path last_fields(const fs::path& folder) {
    fs::path fields = folder / fmt::format("{:.10g}", last_written_time(folder));
    if (!fs::exists(fields / "U")) {
        throw Error(fmt::format(
            "{}: has no reconstructed fields at its last time; run 'reconstructPar -latestTime' there",
            folder.string()));
    }
    return fields;
}

}  // namespace

WallSpacing wall_spacing(const fs::path& case_folder, const PolyMesh& mesh) {
    const FoamDictionary parameters(case_folder / "parameters");
    const double viscosity = parameters.number("viscosity");
    const bool wall_functions =
        parameters.text("simulationType") == "RAS" && parameters.text("nutAtWall") == "nutkWallFunction";
    const fs::path fields = last_fields(case_folder);
    const std::vector<WallFace> faces = wall_faces(mesh);
    if (faces.empty()) {
        throw Error(fmt::format("{}: its mesh has no patch for the body; solve the case again",
                                case_folder.string()));
    }
    const auto require_covered = [&](bool covers) {
        if (covers) return;
        throw Error(fmt::format("{}: fields and mesh do not match; solve the case again", fields.string()));
    };
    std::vector<SpacedArea> parts;
    if (wall_functions) {
        const FoamField<double> k = read_scalar_field(fields / "k");
        for (const WallFace& face : faces) {
            require_covered(k.covers(face.cell));
            const double speed = std::pow(c_mu, 0.25) * std::sqrt(std::max(0.0, k[face.cell]));
            parts.push_back({speed * face.distance / viscosity, face.area});
        }
        return spacing_of(std::move(parts), true);
    }
    const FoamField<Vector3d> velocity = read_vector_field(fields / "U");
    for (const WallFace& face : faces) {
        require_covered(velocity.covers(face.cell));
        const Vector3d& here = velocity[face.cell];
        const double along = (here - here.dot(face.normal) * face.normal).norm();
        parts.push_back({std::sqrt(along * face.distance / viscosity), face.area});
    }
    return spacing_of(std::move(parts), false);
}

namespace {

using Eigen::Vector2d;

/// Returns where the plane with this normal, at the distance `off` from the origin, cuts the face's edges.
std::vector<Vector3d> cuts_of(const std::vector<Vector3d>& corners, const Vector3d& normal, double off) {
    std::vector<Vector3d> cuts;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector3d& one = corners[i];
        const Vector3d& other = corners[(i + 1) % corners.size()];
        const double here = one.dot(normal) - off;
        const double there = other.dot(normal) - off;
        // A corner on the plane counts to one side, so that no edge is cut twice.
        if ((here >= 0.0) == (there >= 0.0)) continue;
        cuts.emplace_back(one + here / (here - there) * (other - one));
    }
    return cuts;
}

}  // namespace

MeshSection mesh_section(const PolyMesh& mesh, const Vector3d& right, const Vector3d& up, double off,
                         double half_width, double half_height) {
    std::vector<char> is_body(mesh.faces.size(), 0);
    for (const FoamPatch& patch : mesh.patches) {
        for (std::size_t i = 0; patch.name.starts_with("body") && i < patch.size; ++i) {
            is_body[patch.start + i] = 1;
        }
    }
    const Vector3d normal = right.cross(up);
    MeshSection section;
    const auto reaches_in = [&](const Vector2d& place) {
        return std::abs(place.x()) < half_width && std::abs(place.y()) < half_height;
    };
    for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
        const std::vector<Vector3d> cuts = cuts_of(mesh.corners(face), normal, off);
        for (std::size_t i = 0; i + 1 < cuts.size(); i += 2) {
            const Vector2d from(cuts[i].dot(right), cuts[i].dot(up));
            const Vector2d to(cuts[i + 1].dot(right), cuts[i + 1].dot(up));
            if (!reaches_in(from) && !reaches_in(to)) continue;
            (is_body[face] != 0 ? section.body : section.cells).emplace_back(from, to);
        }
    }
    return section;
}

}  // namespace samara
