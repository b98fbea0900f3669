#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/contact_points.hpp"
#include "samara/core/collision/hull_separation.hpp"

namespace samara {

/// A flat face of a hull.
struct HullFace {
    Vector3d normal;                   ///< body axes, outwards, of length one
    std::vector<std::size_t> outline;  ///< numbers of corners, anticlockwise from outside
};

/// The faces of the corners' convex hull: of a body without three corners none. They are the same for every
/// size of a body. What lies within a hundred-thousandth of the bounding radius of a face's plane is of the
/// face.
std::vector<HullFace> hull_faces(const ContactPoints& points);

/// A hull that may meet others; all that meet are placed in the same axes.
struct CollisionHull {
    PlacedHull hull;
    const std::vector<HullFace>* faces;
};

/// The plane that parts two hulls.
struct PairSeparation {
    Vector3d normal;     ///< of length one, from the second to the first
    double gap;          ///< m, along the normal; negative where they overlap
    Vector3d on_second;  ///< m: a point of the second that is nearest to the first
    /// Of two that overlap the normal is that of the directions looked at along which they overlap least:
    /// those of their faces and that from middle to middle.
    bool overlap;
};

/// The plane that leaves the widest gap, or one with a gap above `enough` (m), found sooner. Never throws or
/// allocates.
PairSeparation pair_separation(const CollisionHull& first, const CollisionHull& second,
                               double enough) noexcept;

/// The gap (m) between two hulls along a unit vector from the second to the first.
inline double gap_along(const PlacedHull& first, const PlacedHull& second, const Vector3d& normal) noexcept {
    return first.lowest(normal) + second.lowest(-normal);
}

/// Where two hulls may meet: pairs of points that face each other along one normal.
struct HullContact {
    struct Point {
        Vector3d on_first, on_second;  ///< m
        double gap;                    ///< m, along the normal
    };
    Vector3d normal;  ///< of length one, from the second to the first
    double gap;       ///< m: the smallest there is along the normal
    std::array<Point, 8> points;
    std::size_t count = 0;
};

/// Where two hulls come within `reach` (m) of each other: of faces that face each other the outline of what
/// they share, eight points of it at most, else the nearest points. Never throws or allocates.
HullContact hull_contact(const CollisionHull& first, const CollisionHull& second, double reach) noexcept;

}  // namespace samara
