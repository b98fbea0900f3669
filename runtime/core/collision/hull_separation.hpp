#pragma once

#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <optional>
#include <utility>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/contact_points.hpp"
#include "samara/core/collision/obstacle_set.hpp"

namespace samara {

/// A body's convex hull at a place in an obstacle's axes.
struct PlacedHull {
    const ContactPoints* points;
    Matrix3d orientation;  ///< body axes to the obstacle's
    Vector3d position;     ///< of the centre of mass (m)

    /// Returns the point (m) of the hull that is farthest along a unit vector.
    [[nodiscard]] Vector3d farthest(const Vector3d& direction) const noexcept {
        return position +
               orientation * farthest_point(*points, Vector3d(orientation.transpose() * direction));
    }
    /// Returns the lowest coordinate (m) of the hull along a unit vector.
    [[nodiscard]] double lowest(const Vector3d& direction) const noexcept {
        return direction.dot(farthest(-direction));
    }
    [[nodiscard]] double radius() const noexcept { return points->bounding_radius; }
};

/// The plane that separates a hull from a triangle.
struct Separation {
    Vector3d normal;       ///< of length one, from the triangle to the hull
    double gap;            ///< m: between the two along the normal; negative where they overlap
    Vector3d on_triangle;  ///< m: a point of the triangle that is nearest to the hull
    bool of_face;          ///< whether the normal is one of the triangle's own
};

/// Returns the plane with the widest gap, or one with a gap above `enough` (m), which is found sooner. Where
/// the two touch, or overlap by less than a few hundredths of the hull's size, it is the plane that would
/// separate them a little farther apart; where they overlap by more, a plane of the triangle. Never throws or
/// allocates.
///
/// The direction is that between the nearest points of the triangle and the hull shrunk towards its middle by
/// a few hundredths: Gilbert, Johnson and Keerthi, IEEE Journal of Robotics and Automation 4(2), 1988, with
/// the nearest points of simplices as in Ericson, Real-Time Collision Detection (2005), 5.1.
Separation separation(const PlacedHull& hull, const ObstacleTriangle& triangle, double enough) noexcept;

/// Returns the triangle's own plane, with the normal towards the side on which the gap (m) is the wider, and
/// a corner as the point of the triangle. Never throws or allocates.
Separation plane_of_face(const PlacedHull& hull, const ObstacleTriangle& triangle) noexcept;

/// Returns the gap (m) between hull and triangle along a unit vector.
inline double gap_along(const PlacedHull& hull, const ObstacleTriangle& triangle,
                        const Vector3d& normal) noexcept {
    return hull.lowest(normal) - triangle.reach(normal);
}

/// A point of the difference of two convex bodies, and the point of the second that it stems from.
struct Difference {
    Vector3d point;
    Vector3d on_second;
    double share = 0.0;
};

/// A simplex of up to four differences, and its point nearest to the origin: Ericson, Real-Time Collision
/// Detection (2005), 5.1. Never allocates.
struct Simplex {
    std::array<Difference, 4> corners;
    int size = 0;

    [[nodiscard]] Vector3d nearest() const;
    /// Returns the point of the second body that the nearest point stems from.
    [[nodiscard]] Vector3d on_second() const;
    void add(const Difference& corner) { corners[static_cast<std::size_t>(size++)] = corner; }
    /// Keeps the corners that the nearest point lies between. False where the origin lies within the simplex.
    bool reduce();

  private:
    [[nodiscard]] const Difference& at(int i) const { return corners[static_cast<std::size_t>(i)]; }
    [[nodiscard]] const Vector3d& point(int i) const { return at(i).point; }
    /// Keeps corners, in ascending order, with their shares.
    void keep(std::initializer_list<std::pair<int, double>> kept);
    void reduce_segment();
    void reduce_triangle();
    bool reduce_tetrahedron();
};

/// Finds the vector between the nearest points of two convex bodies: Gilbert, Johnson and Keerthi, IEEE
/// Journal of Robotics and Automation 4(2), 1988. `first` and `second` give the point (m) of each body that
/// is farthest along a unit vector. `separation` (m): from the second to the first, at first any guess; where
/// a plane across it leaves a gap above `enough` (m), or it is no longer than `near` (m), it need not be the
/// shortest. Returns the gap (m) that the plane across it leaves, and up to `near` an upper bound of the
/// widest; nothing where the two overlap. Never allocates.
template <typename First, typename Second>
std::optional<double> nearest_separation(const First& first, const Second& second, Simplex& simplex,
                                         Vector3d& separation,
                                         double enough = std::numeric_limits<double>::infinity(),
                                         double near = 0.0) noexcept {
    constexpr int most_rounds = 32;      // five are common, round bodies need a few more
    constexpr double converged = 1e-13;  // of the squared distance
    if (separation.squaredNorm() == 0.0) return {};
    double square = std::numeric_limits<double>::infinity();
    double gap = 0.0;
    for (int round = 0; round < most_rounds; ++round) {
        const Vector3d direction = separation.normalized();
        const Vector3d of_second = second(direction);
        const Vector3d point = first(-direction) - of_second;
        const double separated = separation.dot(point);
        gap = direction.dot(point);
        if (round > 0 && separation.squaredNorm() - separated <= converged * square) return gap;
        if (separated > 0.0 && separated * separated > enough * enough * separation.squaredNorm()) return gap;
        const Simplex before = simplex;
        simplex.add({point, of_second, 1.0});
        const bool is_outside = simplex.reduce();
        const Vector3d next = is_outside ? simplex.nearest() : Vector3d::Zero();
        const double next_square = next.squaredNorm();
        if (!(next_square > 0.0) && separated <= 0.0) return {};
        // Where a plane separates the two already, only rounding places the origin within the simplex.
        if (!(next_square > 0.0) || !(next_square < square)) {
            simplex = before;
            return gap;
        }
        separation = next;
        square = next_square;
        if (square <= near * near) return std::sqrt(square);
    }
    return gap;
}

}  // namespace samara
