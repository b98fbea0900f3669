#include "meshes/checks/sound_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "meshes/checks/flush_faces.hpp"
#include "meshes/checks/triangle_tree.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/surface/surface_check.hpp"
#include "samara/core/surface/welded_surface.hpp"

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

bool share_a_corner(const Triangle& one, const Triangle& two) {
    return std::any_of(one.begin(), one.end(), [&](std::int32_t vertex) { return has(two, vertex); });
}

// Whether the corners of a triangle that are not the base's too lie all on one side of the base's plane,
// farther than the distance: around a corner of many triangles most do.
bool lies_on_one_side(const TriangleTree& tree, std::size_t triangle, std::size_t base, double distance) {
    const Vector3d normal =
        (tree.corner(base, 1) - tree.corner(base, 0)).cross(tree.corner(base, 2) - tree.corner(base, 0));
    const double limit = distance * normal.norm();
    bool above = true;
    bool below = true;
    for (int i = 0; i < 3; ++i) {
        if (has(tree.triangles()[base], tree.triangles()[triangle][static_cast<std::size_t>(i)])) continue;
        const double height = normal.dot(tree.corner(triangle, i) - tree.corner(base, 0));
        above = above && height > limit;
        below = below && height < -limit;
    }
    return above || below;
}

// Triangles that share an edge, and those that only touch, do not cross; those that lie on each other do.
// Takes n log n time.
void require_no_contact(const Surface& surface) {
    const TriangleTree tree(surface.vertices, surface.corners);
    const double tolerance = welding_tolerance * bounding_box(surface).diagonal().norm();
    // Slivers between neighbours may be turned over by rounding.
    const double least_fold = 1e6 * tolerance * tolerance;
    const auto corners = [&](std::size_t t) {
        return std::array{tree.corner(t, 0), tree.corner(t, 1), tree.corner(t, 2)};
    };
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        TriangleTree::Box box = tree.box_of(t);
        box.min().array() -= tolerance;
        box.max().array() += tolerance;
        tree.visit_overlaps(box, [&](std::size_t other) {
            if (other <= t || lies_on_one_side(tree, other, t, tolerance)) return true;
            auto point = pierce_by_sides(tree, t, other);
            if (!point) point = pierce_by_sides(tree, other, t);
            if (point) {
                throw Error(fmt::format(
                    "the surface passes through itself: faces {} and {} cross at {}; join the parts into one "
                    "solid, or where the body is thin use more triangles",
                    t + 1, other + 1, place(*point)));
            }
            const auto patch = flush_patch(corners(t), corners(other), tolerance);
            const bool neighbours = share_a_corner(tree.triangles()[t], tree.triangles()[other]);
            if (patch && (!neighbours || patch->area > least_fold)) {
                throw Error(fmt::format(
                    "the surface touches itself: faces {} and {} lie on each other at {}; join the parts "
                    "there "
                    "into one solid (in Blender: the Boolean modifier, Union), or move them apart",
                    t + 1, other + 1, place(patch->middle)));
            }
            return true;
        });
    }
}

}  // namespace

void require_sound_surface(const Surface& surface) {
    require_bounding_surface(surface);
    require_no_contact(surface);
}

}  // namespace samara
