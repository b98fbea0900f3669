#include "samara/core/collision/hull_separation.hpp"

#include <algorithm>

#include "samara/core/collision/nearest_way.hpp"

namespace samara {
namespace {

// Of the hull, towards its middle. The more, the more askew is the plane beside an edge; the less, the less
// they may overlap.
constexpr double drawn_in = 0.03;
constexpr double better = 1e-6;  // over the radius: gap from which another plane than the face's is taken

const Vector3d& farthest_corner(const ObstacleTriangle& triangle, const Vector3d& direction) {
    const auto& [a, b, c] = triangle.corners;
    const double at_a = a.dot(direction);
    const double at_b = b.dot(direction);
    const double at_c = c.dot(direction);
    if (at_a >= at_b && at_a >= at_c) return a;
    return at_b >= at_c ? b : c;
}

/// From the nearest point of the triangle to that of the hull drawn in. False where the two overlap.
bool nearest_to_triangle(const PlacedHull& hull, const ObstacleTriangle& triangle, Simplex& simplex,
                         Vector3d& way) {
    const Vector3d middle = hull.position + hull.orientation * hull.points->middle;
    const auto of_hull = [&](const Vector3d& direction) {
        const Vector3d point = hull.farthest(direction);
        return Vector3d(point + drawn_in * (middle - point));
    };
    const auto of_triangle = [&](const Vector3d& direction) { return farthest_corner(triangle, direction); };
    way = middle - triangle.corners[0];
    return nearest_way(of_hull, of_triangle, simplex, way);
}

}  // namespace

Separation separation(const PlacedHull& hull, const ObstacleTriangle& triangle, double enough) noexcept {
    const double plane = triangle.normal.dot(triangle.corners[0]);
    const double above = hull.lowest(triangle.normal) - plane;
    const double below = hull.lowest(-triangle.normal) + plane;
    Separation best{above >= below ? triangle.normal : Vector3d(-triangle.normal), std::max(above, below),
                    triangle.corners[0], true};
    if (best.gap > enough) return best;
    Simplex simplex;
    Vector3d way;
    if (!nearest_to_triangle(hull, triangle, simplex, way)) return best;
    best.on_triangle = simplex.on_second();
    const Vector3d normal = way.normalized();
    const double gap = gap_along(hull, triangle, normal);
    if (gap <= best.gap + better * hull.radius()) return best;
    return {normal, gap, best.on_triangle, false};
}

}  // namespace samara
