#pragma once

#include <array>
#include <cstddef>
#include <optional>
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

/// Returns the faces of the corners' convex hull; none for a body with fewer than three corners. They are the
/// same for every size of a body. Points within a hundred-thousandth of the bounding radius of a face's plane
/// belong to the face.
std::vector<HullFace> hull_faces(const ContactPoints& points);

/// A hull that may touch others. All hulls of one call are placed in the same axes.
struct CollisionHull {
    PlacedHull hull;
    const std::vector<HullFace>* faces;
};

/// The plane that separates two hulls.
struct PairSeparation {
    Vector3d normal;     ///< of length one, from the second to the first
    double gap;          ///< m, along the normal; negative where they overlap
    Vector3d on_second;  ///< m: a point of the second that is nearest to the first
    /// Whether the two overlap. The normal is then the direction, among those of their faces and that from
    /// middle to middle, along which they overlap least.
    bool overlap;
};

/// Returns the vector (m) from the middle of the second hull to that of the first.
Vector3d between_middles(const CollisionHull& first, const CollisionHull& second) noexcept;

/// Returns the plane with the widest gap, or one with a gap above `enough` (m), which is found sooner;
/// nothing where the two overlap. `separation`: a guess of its normal, of any length. The point is unknown
/// where the gap is above `enough`. Never throws or allocates.
std::optional<PairSeparation> plane_between(const CollisionHull& first, const CollisionHull& second,
                                            double enough, Vector3d separation) noexcept;

/// Returns plane_between(), or the direction along which the two overlap least, which takes longer to find.
/// Never throws or allocates.
PairSeparation pair_separation(const CollisionHull& first, const CollisionHull& second,
                               double enough) noexcept;

/// Returns whether the gap between two hulls is at most a distance (m), where plane_between() would find so.
/// Never throws or allocates.
bool come_within(const CollisionHull& first, const CollisionHull& second, double distance) noexcept;

/// Returns the gap (m) between two hulls along a unit vector from the second to the first.
inline double gap_along(const PlacedHull& first, const PlacedHull& second, const Vector3d& normal) noexcept {
    return first.lowest(normal) + second.lowest(-normal);
}

/// Points where two hulls may touch: pairs that face each other along one normal.
struct HullContact {
    struct Point {
        Vector3d on_first, on_second;  ///< m
        double gap;                    ///< m, along the normal
    };
    Vector3d normal;  ///< of length one, from the second to the first
    double gap;       ///< m: the smallest gap along the normal
    std::array<Point, 8> points;
    std::size_t count = 0;
};

/// Returns the points where two hulls come within `reach` (m) of each other: of faces that face each other
/// the outline of their common part, eight points of it at most, else the nearest points. `apart`: the result
/// of pair_separation() with `reach` or more as what is enough. Never throws or allocates.
HullContact hull_contact(const CollisionHull& first, const CollisionHull& second, const PairSeparation& apart,
                         double reach) noexcept;

}  // namespace samara
