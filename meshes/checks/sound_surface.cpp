#include "meshes/checks/sound_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "meshes/checks/triangle_tree.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/surface/surface_check.hpp"
#include "samara/core/surface/welded_surface.hpp"

namespace samara {
namespace {

// A crossing lies inside the triangle and the segment by this relative margin: triangles that only touch do
// not cross.
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

// Returns where a side of the triangle `sides` pierces the triangle `target`. Sides that end on a corner of
// the target are skipped.
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

// Whether all corners that the triangle does not share with the base lie on one side of the base's plane,
// farther than `distance`. Most triangles around a common corner do, which saves the longer tests.
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
    // Rounding may overturn slivers between neighbours.
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
                throw Error(
                    fmt::format("the surface intersects itself: faces {} and {} cross at {}; join the parts "
                                "into one solid, or use more triangles if the body is thin",
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

namespace {

constexpr double least_share = 1e-6;  // of the smaller triangle's area
constexpr double most_slope = 0.1;    // sine of the angle between the triangles
constexpr double most_seam_distance =
    1e-4;  // relative to the width of the patch: the sides of a sharp wedge do not touch

// Returns twice the signed area of the triangle in the xy-plane, positive for counterclockwise corners.
double twice_signed_area(const Vector3d& from, const Vector3d& to, const Vector3d& p) {
    return (to.x() - from.x()) * (p.y() - from.y()) - (to.y() - from.y()) * (p.x() - from.x());
}

// Whether a triangle lies to the right of a line or on it, as most that share a corner or a side do.
bool lies_beside(const std::array<Vector3d, 3>& triangle, const Vector3d& from, const Vector3d& to) {
    constexpr double rounding = 1e-12;
    return std::all_of(triangle.begin(), triangle.end(), [&](const Vector3d& p) {
        return twice_signed_area(from, to, p) <= rounding * (to - from).norm() * (p - from).norm();
    });
}

// Clips a convex polygon to the left of the line from `from` to `to` in the xy-plane; z is interpolated.
void keep_left(std::vector<Vector3d>& polygon, const Vector3d& from, const Vector3d& to) {
    const auto side = [&](const Vector3d& p) { return twice_signed_area(from, to, p); };
    std::vector<Vector3d> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vector3d& p = polygon[i];
        const Vector3d& q = polygon[(i + 1) % polygon.size()];
        const double here = side(p);
        const double there = side(q);
        if (here >= 0.0) kept.push_back(p);
        if ((here > 0.0 && there < 0.0) || (here < 0.0 && there > 0.0)) {
            kept.emplace_back(p + here / (here - there) * (q - p));
        }
    }
    polygon = std::move(kept);
}

double twice_the_area(const std::vector<Vector3d>& polygon) {
    double sum = 0.0;
    for (std::size_t i = 2; i < polygon.size(); ++i)
        sum += twice_signed_area(polygon[0], polygon[i - 1], polygon[i]);
    return std::abs(sum);
}

}  // namespace

std::optional<FlushPatch> flush_patch(const std::array<Vector3d, 3>& a, const std::array<Vector3d, 3>& b,
                                      double tolerance) {
    const Vector3d across = (a[1] - a[0]).cross(a[2] - a[0]);
    const Vector3d its = (b[1] - b[0]).cross(b[2] - b[0]);
    const Vector3d normal = across.normalized();
    if (its.cross(normal).norm() > most_slope * its.norm()) return std::nullopt;
    Matrix3d frame;  // rows: two axes in the plane of a, its normal
    frame.row(0) = (a[1] - a[0]).normalized();
    frame.row(1) = normal.cross(frame.row(0).transpose());
    frame.row(2) = normal;
    const std::array<double, 3> heights = {normal.dot(b[0] - a[0]), normal.dot(b[1] - a[0]),
                                           normal.dot(b[2] - a[0])};
    const auto [low, high] = std::minmax({heights[0], heights[1], heights[2]});
    if (low > tolerance || high < -tolerance) return std::nullopt;
    std::array<Vector3d, 3> base;
    std::array<Vector3d, 3> side;
    for (std::size_t i = 0; i < 3; ++i) {
        base[i] = frame * (a[i] - a[0]);
        side[i] = frame * (b[i] - a[0]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        if (lies_beside(side, base[i], base[(i + 1) % 3])) return std::nullopt;
    }
    std::vector<Vector3d> patch(side.begin(), side.end());
    for (std::size_t i = 0; i < 3; ++i) keep_left(patch, base[i], base[(i + 1) % 3]);
    const double area = 0.5 * twice_the_area(patch);
    if (patch.size() < 3 || area < 0.5 * least_share * std::min(across.norm(), its.norm()))
        return std::nullopt;
    const double limit = std::min(tolerance, most_seam_distance * std::sqrt(area));
    Vector3d middle = Vector3d::Zero();
    for (const Vector3d& corner : patch) {
        if (std::abs(corner.z()) > limit) return std::nullopt;
        middle += corner / static_cast<double>(patch.size());
    }
    return FlushPatch{area, a[0] + frame.transpose() * middle};
}

}  // namespace samara
