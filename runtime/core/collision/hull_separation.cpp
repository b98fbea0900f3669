#include "samara/core/collision/hull_separation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace samara {
namespace {

// The share by which the hull is shrunk towards its middle. The larger it is, the more oblique is the plane
// beside an edge; the smaller, the less the two may overlap.
constexpr double triangle_drawn_in = 0.03;
// relative to the radius: the gap from which another plane is preferred to the face's
constexpr double better = 1e-6;
constexpr double none = 1e-9;  // relative to the radius: overlap that counts as none

const Vector3d& farthest_corner(const ObstacleTriangle& triangle, const Vector3d& direction) {
    const auto& [a, b, c] = triangle.corners;
    const double at_a = a.dot(direction);
    const double at_b = b.dot(direction);
    const double at_c = c.dot(direction);
    if (at_a >= at_b && at_a >= at_c) return a;
    return at_b >= at_c ? b : c;
}

/// Finds the vector from the nearest point of the triangle to that of the shrunk hull. False where the two
/// overlap.
bool nearest_to_triangle(const PlacedHull& hull, const ObstacleTriangle& triangle, Simplex& simplex,
                         Vector3d& separation) {
    const Vector3d middle = hull.position + hull.orientation * hull.points->middle;
    const auto of_hull = [&](const Vector3d& direction) {
        const Vector3d point = hull.farthest(direction);
        return Vector3d(point + triangle_drawn_in * (middle - point));
    };
    const auto of_triangle = [&](const Vector3d& direction) { return farthest_corner(triangle, direction); };
    separation = middle - triangle.corners[0];
    return nearest_separation(of_hull, of_triangle, simplex, separation).has_value();
}

/// Returns whether a corner of the hull lies over or under the triangle and no farther from it than the whole
/// hull: then no plane has a wider gap than the triangle's own.
bool any_lowest_corner_is_over(const PlacedHull& hull, const ObstacleTriangle& triangle,
                               const Separation& face) {
    const Vector3d up = hull.orientation.transpose() * face.normal;
    const double lowest =
        face.normal.dot(triangle.corners[0] - hull.position) + face.gap + none * hull.radius();
    const auto& corners = hull.points->corners;
    return std::any_of(corners.begin(), corners.end(), [&](const Vector3d& corner) {
        return up.dot(corner) <= lowest && triangle.is_under(hull.position + hull.orientation * corner, 0.0);
    });
}

}  // namespace

Separation plane_of_face(const PlacedHull& hull, const ObstacleTriangle& triangle) noexcept {
    const double plane = triangle.normal.dot(triangle.corners[0]);
    const double above = hull.lowest(triangle.normal) - plane;
    const double below = hull.lowest(-triangle.normal) + plane;
    return {above >= below ? triangle.normal : Vector3d(-triangle.normal), std::max(above, below),
            triangle.corners[0], true};
}

Separation separation(const PlacedHull& hull, const ObstacleTriangle& triangle, double enough) noexcept {
    Separation best = plane_of_face(hull, triangle);
    if (best.gap > enough) return best;
    if (best.gap >= -none * hull.radius() && any_lowest_corner_is_over(hull, triangle, best)) return best;
    Simplex simplex;
    Vector3d separation;
    if (!nearest_to_triangle(hull, triangle, simplex, separation)) return best;
    best.on_triangle = simplex.on_second();
    const Vector3d normal = separation.normalized();
    const double gap = gap_along(hull, triangle, normal);
    if (gap <= best.gap + better * hull.radius()) return best;
    return {normal, gap, best.on_triangle, false};
}

namespace {

constexpr double flat = 1e-9;  // sine of the angle between a face and a corner that lies in its plane

}  // namespace

Vector3d Simplex::nearest() const {
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < size; ++i) sum += at(i).share * at(i).point;
    return sum;
}

Vector3d Simplex::on_second() const {
    Vector3d sum = Vector3d::Zero();
    for (int i = 0; i < size; ++i) sum += at(i).share * at(i).on_second;
    return sum;
}

void Simplex::keep(std::initializer_list<std::pair<int, double>> kept) {
    size = 0;
    for (const auto& [i, share] : kept) {
        if (i != size) corners[static_cast<std::size_t>(size)] = at(i);
        corners[static_cast<std::size_t>(size++)].share = share;
    }
}

bool Simplex::reduce() {
    if (size == 1) {
        corners[0].share = 1.0;
    } else if (size == 2) {
        reduce_segment();
    } else if (size == 3) {
        reduce_triangle();
    } else {
        return reduce_tetrahedron();
    }
    return true;
}

void Simplex::reduce_segment() {
    const Vector3d separation = point(1) - point(0);
    const double square = separation.squaredNorm();
    const double share = square > 0.0 ? -point(0).dot(separation) / square : 0.0;
    if (share <= 0.0) return keep({{0, 1.0}});
    if (share >= 1.0) return keep({{1, 1.0}});
    keep({{0, 1.0 - share}, {1, share}});
}

void Simplex::reduce_triangle() {
    const Vector3d& a = point(0);
    const Vector3d& b = point(1);
    const Vector3d& c = point(2);
    const Vector3d ab = b - a;
    const Vector3d ac = c - a;
    const double d1 = -ab.dot(a);
    const double d2 = -ac.dot(a);
    if (d1 <= 0.0 && d2 <= 0.0) return keep({{0, 1.0}});
    const double d3 = -ab.dot(b);
    const double d4 = -ac.dot(b);
    if (d3 >= 0.0 && d4 <= d3) return keep({{1, 1.0}});
    const double d5 = -ab.dot(c);
    const double d6 = -ac.dot(c);
    if (d6 >= 0.0 && d5 <= d6) return keep({{2, 1.0}});
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
        const double share = d1 / (d1 - d3);
        return keep({{0, 1.0 - share}, {1, share}});
    }
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
        const double share = d2 / (d2 - d6);
        return keep({{0, 1.0 - share}, {2, share}});
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        const double share = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return keep({{1, 1.0 - share}, {2, share}});
    }
    const double all = va + vb + vc;
    if (!(all > 0.0)) return reduce_segment();
    keep({{0, va / all}, {1, vb / all}, {2, vc / all}});
}

bool Simplex::reduce_tetrahedron() {
    constexpr int faces[4][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}, {1, 3, 2, 0}};
    const Simplex whole = *this;
    double nearest_yet = std::numeric_limits<double>::infinity();
    for (const auto& face : faces) {
        const Vector3d& a = whole.point(face[0]);
        const Vector3d normal = (whole.point(face[1]) - a).cross(whole.point(face[2]) - a);
        const double origin_side = -normal.dot(a);
        const Vector3d height = whole.point(face[3]) - a;
        const double other_side = normal.dot(height);
        // Every face of a tetrahedron without volume may be the nearest.
        const bool is_flat = std::abs(other_side) <= flat * normal.norm() * height.norm();
        if (!is_flat && origin_side * other_side > 0.0) continue;
        Simplex part;
        for (int i = 0; i < 3; ++i) part.add(whole.at(face[i]));
        part.reduce_triangle();
        const double square = part.nearest().squaredNorm();
        if (square >= nearest_yet) continue;
        nearest_yet = square;
        *this = part;
    }
    return std::isfinite(nearest_yet);
}

}  // namespace samara
