#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <numbers>
#include <utility>

#include "samara/core/body/body.hpp"

namespace samara::test {

/// The unit sphere as an octahedron whose faces were cut into four `rounds` times: 8 * 4^rounds triangles.
inline Surface unit_sphere(int rounds) {
    Surface surface;
    surface.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    surface.corners = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                       {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int round = 0; round < rounds; ++round) {
        std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
        const auto middle = [&](std::int32_t a, std::int32_t b) {
            const auto [place, is_new] =
                middles.try_emplace(std::minmax(a, b), static_cast<std::int32_t>(surface.vertices.size()));
            if (is_new) {
                const Vector3d sum = surface.vertices[static_cast<std::size_t>(a)] +
                                     surface.vertices[static_cast<std::size_t>(b)];
                surface.vertices.push_back(sum.normalized());
            }
            return place->second;
        };
        std::vector<std::array<std::int32_t, 3>> finer;
        for (const auto& [a, b, c] : surface.corners) {
            const std::int32_t ab = middle(a, b);
            const std::int32_t bc = middle(b, c);
            const std::int32_t ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
        }
        surface.corners = std::move(finer);
    }
    return surface;
}

/// An ellipsoid of the given semi-axes (m) about `center`, with its exact volume moments, its mirrors and its
/// turns by 180 degrees, and a Kirchhoff tensor of the right size (that of the sphere of equal volume).
inline Body ellipsoid(const Vector3d& semi_axes, const Vector3d& center = Vector3d::Zero(), int rounds = 3) {
    Body body;
    body.name = "ellipsoid";
    body.source = "ellipsoid of a test";
    body.surface = unit_sphere(rounds);
    for (Vector3d& vertex : body.surface.vertices) vertex = center + semi_axes.cwiseProduct(vertex);
    body.moments.volume = 4.0 / 3.0 * std::numbers::pi * semi_axes.prod();
    body.moments.centroid = center;
    body.moments.second_moments =
        (body.moments.volume / 5.0 * semi_axes.array().square()).matrix().asDiagonal();
    body.moments.surface_area = surface_area(body.surface);
    body.symmetry.elements.clear();
    for (const double x : {1.0, -1.0}) {
        for (const double y : {1.0, -1.0}) {
            for (const double z : {1.0, -1.0}) {
                body.symmetry.elements.emplace_back(Vector3d(x, y, z).asDiagonal());
            }
        }
    }
    body.symmetry.tolerance = 1e-9;
    KirchhoffTensor kirchhoff;
    kirchhoff.matrix.bottomRightCorner<3, 3>() = 0.5 * body.moments.volume * Matrix3d::Identity();
    kirchhoff.method = "sphere of equal volume";
    body.kirchhoff = kirchhoff;
    return body;
}

/// Returns a sphere, whose symmetry is every rotation, likewise.
inline Body sphere(double radius, int rounds = 3) {
    Body body = ellipsoid(Vector3d::Constant(radius), Vector3d::Zero(), rounds);
    body.name = "sphere";
    body.symmetry.type = Symmetry::Type::spherical;
    return body;
}

/// A box of the given edges (m) about the origin, each side cut into `cells` x `cells` x 2 triangles, with
/// the symmetry of a box of three different edges.
inline Body box_body(const Vector3d& edges, int cells = 8) {
    Body body = ellipsoid(edges / 2.0);
    body.name = "box";
    body.source = "box of a test";
    body.surface = {};
    const auto point = [&](int axis, double sign, double u, double v) {
        Vector3d place;
        place[axis] = sign;
        place[(axis + 1) % 3] = u;
        place[(axis + 2) % 3] = v;
        return Vector3d(edges.cwiseProduct(place) / 2.0);
    };
    for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {1.0, -1.0}) {
            const auto first = static_cast<std::int32_t>(body.surface.vertices.size());
            for (int i = 0; i <= cells; ++i) {
                for (int j = 0; j <= cells; ++j) {
                    body.surface.vertices.push_back(
                        point(axis, sign, 2.0 * i / cells - 1.0, 2.0 * j / cells - 1.0));
                }
            }
            for (int i = 0; i < cells; ++i) {
                for (int j = 0; j < cells; ++j) {
                    const std::int32_t a = first + i * (cells + 1) + j;
                    const std::int32_t b = a + cells + 1;
                    if (sign > 0.0) {
                        body.surface.corners.insert(body.surface.corners.end(),
                                                    {{a, b, b + 1}, {a, b + 1, a + 1}});
                    } else {
                        body.surface.corners.insert(body.surface.corners.end(),
                                                    {{a, b + 1, b}, {a, a + 1, b + 1}});
                    }
                }
            }
        }
    }
    body.moments.volume = edges.prod();
    body.moments.second_moments = (body.moments.volume / 12.0 * edges.array().square()).matrix().asDiagonal();
    body.moments.surface_area = surface_area(body.surface);
    return body;
}

}  // namespace samara::test
