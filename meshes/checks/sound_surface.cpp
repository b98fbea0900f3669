#include "meshes/checks/sound_surface.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "internal/body/surface_check.hpp"
#include "meshes/checks/triangle_tree.hpp"
#include "samara/base/error.hpp"

namespace samara {
namespace {

// Strictly inside by this part of the triangle and of the segment: what only touches does not cross.
constexpr double margin = 1e-6;

using Triangle = TriangleTree::Triangle;

// Moeller and Trumbore, Fast, Minimum Storage Ray-Triangle Intersection, 1997, for a segment.
std::optional<Vector3d> pierce(const Vector3d& from, const Vector3d& to, const TriangleTree& tree,
                               std::size_t triangle) {
    const Vector3d along = to - from;
    const Vector3d first = tree.corner(triangle, 1) - tree.corner(triangle, 0);
    const Vector3d second = tree.corner(triangle, 2) - tree.corner(triangle, 0);
    const Vector3d across = along.cross(second);
    const double determinant = first.dot(across);
    if (std::abs(determinant) <= 1e-12 * along.norm() * first.cross(second).norm()) return std::nullopt;
    const Vector3d offset = from - tree.corner(triangle, 0);
    const double u = offset.dot(across) / determinant;
    const Vector3d normal = offset.cross(first);
    const double v = along.dot(normal) / determinant;
    const double t = second.dot(normal) / determinant;
    if (u < margin || v < margin || u + v > 1.0 - margin || t < margin || t > 1.0 - margin)
        return std::nullopt;
    return from + t * along;
}

bool has(const Triangle& triangle, std::int32_t vertex) {
    return std::find(triangle.begin(), triangle.end(), vertex) != triangle.end();
}

// The first side of `sides` that goes through `target`, sides that end on a corner of the target left out.
std::optional<Vector3d> pierce_by_sides(const TriangleTree& tree, std::size_t sides, std::size_t target) {
    const Triangle& its = tree.triangles()[target];
    for (int i = 0; i < 3; ++i) {
        const Triangle& mine = tree.triangles()[sides];
        const int next = (i + 1) % 3;
        if (has(its, mine[static_cast<std::size_t>(i)]) || has(its, mine[static_cast<std::size_t>(next)]))
            continue;
        if (auto point = pierce(tree.corner(sides, i), tree.corner(sides, next), tree, target)) return point;
    }
    return std::nullopt;
}

// Two flat triangles, and a point where a side of the one goes through the other.
struct Crossing {
    std::size_t first = 0;
    std::size_t second = 0;
    Vector3d point = Vector3d::Zero();
};

// Triangles that share an edge, and those that only touch, do not cross. Takes n log n time.
std::optional<Crossing> find_crossing(const Surface& surface) {
    const TriangleTree tree(surface.vertices, surface.corners);
    std::optional<Crossing> crossing;
    for (std::size_t t = 0; t < surface.triangle_count() && !crossing; ++t) {
        tree.visit_overlaps(tree.box_of(t), [&](std::size_t other) {
            if (other <= t) return true;
            auto point = pierce_by_sides(tree, t, other);
            if (!point) point = pierce_by_sides(tree, other, t);
            if (point) crossing = Crossing{t, other, *point};
            return !crossing.has_value();
        });
    }
    return crossing;
}

}  // namespace

void require_sound_surface(const Surface& surface) {
    require_bounding_surface(surface);
    if (const auto crossing = find_crossing(surface)) {
        throw Error(
            fmt::format("the surface passes through itself: faces {} and {} cross at {}; join the parts "
                        "into one solid, or where the body is thin use more triangles",
                        crossing->first + 1, crossing->second + 1, place(crossing->point)));
    }
}

}  // namespace samara
