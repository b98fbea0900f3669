#pragma once

#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// The points where a body can touch a plane: the extreme points of its convex hull, in body axes from the
/// centre of mass (m).
struct ContactPoints {
    /// Corners and points along sharp edges, 64 at most, well spread.
    std::vector<Vector3d> corners;
    /// For bodies with round sides: the lowest point in every direction of the octahedral map, smoothed over
    /// the facets of the mesh, so that a round body rolls. Empty where the corners alone are the hull.
    std::vector<Vector3d> round;
    double bounding_radius = 0.0;        ///< m: of the sphere about the centre of mass that holds the body
    Vector3d middle = Vector3d::Zero();  ///< m: the mean of all of these points, within the hull
};
inline constexpr std::size_t most_corners = 64;

/// Returns the contact points of a surface for a centre of mass (m, shape axes). Edges whose faces stand at
/// more than 0.6 rad to each other are sharp. Corners lie on the surface; curved edges become polygons. A
/// body without sharp edges touches on its surface; a round side of a body with sharp edges sinks by 1 % of
/// the bounding radius at most. Bodies that are not convex touch with their hull.
ContactPoints contact_points(const Surface& surface, const Vector3d& center_of_mass);

/// Returns the lowest point of the round sides (m, body axes from the centre of mass) where the unit vector
/// `down` (body axes) points to the ground. `round` must not be empty.
Vector3d lowest_round_point(const ContactPoints& points, const Vector3d& down) noexcept;

/// Returns the point of the hull (m, body axes from the centre of mass) that is farthest along the unit
/// vector `direction` (body axes).
Vector3d farthest_point(const ContactPoints& points, const Vector3d& direction) noexcept;

/// Returns the distance (m) that the body reaches from its centre of mass along the unit vector `direction`
/// (body axes).
double reach(const ContactPoints& points, const Vector3d& direction) noexcept;

}  // namespace samara
