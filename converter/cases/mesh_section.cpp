#include "converter/cases/mesh_section.hpp"

#include <cmath>

namespace samara {
namespace {

using Eigen::Vector2d;

/// Where the plane of the normal, so far off the origin, cuts the face's edges.
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
