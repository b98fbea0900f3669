#pragma once

#include <array>
#include <cstddef>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/contact_points.hpp"

namespace samara {

/// Coulomb's coefficient of friction between every body and the ground: chosen, not measured. Handbooks have
/// 0.25 to 0.5 for dry wood on wood.
inline constexpr double ground_friction = 0.5;

/// A point of the body that may touch something within a step.
struct NearPoint {
    Vector3d point;   ///< body axes, from the centre of mass (m)
    Vector3d normal;  ///< body axes: outwards from what it may touch
    double gap;       ///< m, along the normal
    double friction;
    int obstacle;                       ///< the number of the obstacle that it may touch; -1: level ground
    Vector3d surface_velocity;          ///< m/s, body axes: of what it may touch, relative to the ground
    Vector3d surface_angular_velocity;  ///< rad/s, body axes: of what it may touch

    [[nodiscard]] bool on_ground() const noexcept { return obstacle < 0; }
};

/// All that a body may touch in a step, as planes at points of its hull: the ground's below each point, and
/// an obstacle's where its faces, edges and corners are near. Room for `most_near_points`; where there are
/// more, those with the smallest gaps are kept. Never allocates.
class ContactSet {
  public:
    /// `to_world`: rotates body axes to the world's.
    explicit ContactSet(const Matrix3d& to_world) noexcept : to_world_(to_world) {}

    /// Adds the body's points that lie within `margin` (m) of level ground, `height` (m) below its centre of
    /// mass.
    void add_ground(const ContactPoints& points, double height, double margin) noexcept;
    void add(const NearPoint& near) noexcept;

    [[nodiscard]] const Matrix3d& to_world() const noexcept { return to_world_; }
    [[nodiscard]] const NearPoint* begin() const noexcept { return points_.data(); }
    [[nodiscard]] const NearPoint* end() const noexcept { return points_.data() + count_; }
    [[nodiscard]] bool empty() const noexcept { return count_ == 0; }

  private:
    Matrix3d to_world_;
    std::array<NearPoint, 2 * most_corners> points_;
    std::size_t count_ = 0;
};
inline constexpr std::size_t most_near_points = 2 * most_corners;

}  // namespace samara
