#pragma once

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/contact_points.hpp"
#include "samara/core/collision/obstacle_set.hpp"

namespace samara {

/// A body's convex hull at a place in an obstacle's axes.
struct PlacedHull {
    const ContactPoints* points;
    Matrix3d orientation;  ///< body axes to the obstacle's
    Vector3d position;     ///< of the centre of mass (m)

    /// The point (m) of the hull that is farthest along a unit vector.
    [[nodiscard]] Vector3d farthest(const Vector3d& direction) const noexcept {
        return position +
               orientation * farthest_point(*points, Vector3d(orientation.transpose() * direction));
    }
    /// The lowest coordinate (m) of the hull along a unit vector.
    [[nodiscard]] double lowest(const Vector3d& direction) const noexcept {
        return direction.dot(farthest(-direction));
    }
    [[nodiscard]] double radius() const noexcept { return points->bounding_radius; }
};

/// The plane that parts a hull from a triangle.
struct Separation {
    Vector3d normal;       ///< of length one, from the triangle to the hull
    double gap;            ///< m: between the two along the normal; negative where they overlap
    Vector3d on_triangle;  ///< m: a point of the triangle that is nearest to the hull
    bool of_face;          ///< whether the normal is one of the triangle's own
};

/// The plane that leaves the widest gap, or one with a gap above `enough` (m), found sooner. Where the two
/// touch, or overlap by less than a few hundredths of the hull's size, it is the same plane that would part
/// them a little farther off; where they overlap by more, a plane of the triangle. Never throws or allocates.
///
/// The direction is that of the nearest points of the triangle and the hull drawn in to its middle by a few
/// hundredths: Gilbert, Johnson and Keerthi, IEEE Journal of Robotics and Automation 4(2),
/// 1988, with the nearest points of simplices as in Ericson, Real-Time Collision Detection (2005), 5.1.
Separation separation(const PlacedHull& hull, const ObstacleTriangle& triangle, double enough) noexcept;

/// The gap (m) between hull and triangle along a unit vector.
inline double gap_along(const PlacedHull& hull, const ObstacleTriangle& triangle,
                        const Vector3d& normal) noexcept {
    return hull.lowest(normal) - triangle.reach(normal);
}

}  // namespace samara
