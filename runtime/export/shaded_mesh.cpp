#include "samara/export/shaded_mesh.hpp"

#include <cmath>

#include "samara/core/surface/curved_surface.hpp"

namespace samara {
namespace {

struct Corner {
    std::size_t triangle;
    int place;
};

/// Returns for each vertex the corners of triangles that share it.
std::vector<std::vector<Corner>> corners_by_vertex(const Surface& surface) {
    std::vector<std::vector<Corner>> corners(surface.vertices.size());
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        for (int place = 0; place < 3; ++place) {
            const auto vertex = static_cast<std::size_t>(surface.corners[t][static_cast<std::size_t>(place)]);
            corners[vertex].push_back({t, place});
        }
    }
    return corners;
}

/// Returns the angle (rad) of a triangle at one of its corners.
double corner_angle(const Surface& surface, const Corner& corner) {
    const auto vertex = [&](int place) -> const Vector3d& {
        const auto& triangle = surface.corners[corner.triangle];
        return surface.vertices[static_cast<std::size_t>(triangle[static_cast<std::size_t>(place % 3)])];
    };
    const Vector3d& here = vertex(corner.place);
    const Vector3d a = vertex(corner.place + 1) - here;
    const Vector3d b = vertex(corner.place + 2) - here;
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

ShadedMesh shaded_mesh(const Surface& surface, double sharp_angle) {
    const Surface flat = flattened_surface(surface);
    std::vector<Vector3d> faces(flat.triangle_count());
    for (std::size_t t = 0; t < faces.size(); ++t) faces[t] = area_vector(flat, t).stableNormalized();
    const auto has_area = [&](std::size_t t) { return faces[t].squaredNorm() > 0.5; };

    const double least_cosine = std::cos(sharp_angle);
    ShadedMesh mesh;
    std::vector<std::array<std::uint32_t, 3>> indices(flat.triangle_count());
    const auto corners = corners_by_vertex(flat);
    for (std::size_t vertex = 0; vertex < corners.size(); ++vertex) {
        const std::size_t first = mesh.positions.size();
        for (const Corner& corner : corners[vertex]) {
            if (!has_area(corner.triangle)) continue;
            Vector3d sum = Vector3d::Zero();
            for (const Corner& other : corners[vertex]) {
                if (faces[other.triangle].dot(faces[corner.triangle]) >= least_cosine) {
                    sum += corner_angle(flat, other) * faces[other.triangle];
                }
            }
            const Vector3d normal = sum.normalized();
            std::size_t index = first;
            while (index < mesh.normals.size() && mesh.normals[index] != normal) ++index;
            if (index == mesh.normals.size()) {
                mesh.positions.push_back(flat.vertices[vertex]);
                mesh.normals.push_back(normal);
            }
            indices[corner.triangle][static_cast<std::size_t>(corner.place)] =
                static_cast<std::uint32_t>(index);
        }
    }
    for (std::size_t t = 0; t < indices.size(); ++t) {
        if (has_area(t)) mesh.triangles.push_back(indices[t]);
    }
    return mesh;
}

}  // namespace samara
