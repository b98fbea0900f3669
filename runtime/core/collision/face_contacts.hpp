#pragma once

#include "samara/core/collision/contact_set.hpp"
#include "samara/core/collision/hull_separation.hpp"

namespace samara {

/// The velocity of the surface of an obstacle, in its own axes.
struct ContactSurfaceVelocity {
    Vector3d angular_velocity = Vector3d::Zero();  ///< rad/s
    Vector3d linear_velocity = Vector3d::Zero();   ///< m/s: of its origin

    [[nodiscard]] Vector3d at(const Vector3d& place) const noexcept {
        return linear_velocity + angular_velocity.cross(place);
    }
};

/// Finds the points where a body's hull and the faces of one obstacle may touch within a step, each face by
/// itself, in the obstacle's axes. Never allocates.
class FaceContacts {
  public:
    /// `velocity`: of the body, (omega, v) in its axes (rad/s, m/s); `margin`: m, at least as far as any
    /// point moves relative to the obstacle in the step; `obstacle`: its number. Points are added to `near`.
    FaceContacts(const PlacedHull& hull, const Vector6d& velocity, const ContactSurfaceVelocity& surface,
                 double time_step, double margin, double friction, int obstacle, ContactSet& near) noexcept;

    /// Adds the points where the body may touch a face: its corners, and its lowest round point, that come to
    /// lie over the face; the ends of the parts of the face's sides under its lowest side; the nearest points
    /// where an edge or a corner of the face faces it. An edge between two faces of one plane counts as
    /// neither. A face that it would pass by at its present velocity is left out.
    void add(const ObstacleTriangle& triangle) noexcept;

  private:
    /// Returns whether any point may come to lie over a face in the step, in which none moves by more than
    /// the margin.
    [[nodiscard]] bool may_touch_inside(const ObstacleTriangle& triangle) const noexcept;
    [[nodiscard]] bool passes_by(const ObstacleTriangle& triangle, const Separation& now) const noexcept;
    void add_point(const Vector3d& of_body, const Vector3d& normal, double gap) noexcept;
    void add_corners(const ObstacleTriangle& triangle, const Vector3d& normal, double plane) noexcept;
    /// Adds the corners, and the lowest round point, that come to lie over a face, however it may be reached.
    void add_inside(const ObstacleTriangle& triangle) noexcept;
    bool add_crossings(const ObstacleTriangle& triangle, const Vector3d& normal, double plane) noexcept;

    PlacedHull hull_;
    PlacedHull next_;  ///< the place after the step at the present velocity, as the obstacle sees it
    Vector6d velocity_;
    ContactSurfaceVelocity surface_;
    double time_step_, margin_, friction_;
    int obstacle_;
    ContactSet& near_;
};

}  // namespace samara
