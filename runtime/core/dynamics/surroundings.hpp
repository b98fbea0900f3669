#pragma once

#include <memory>
#include <optional>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/collision/obstacle_set.hpp"
#include "samara/core/physics/fluid.hpp"
#include "samara/core/wind/wind_field.hpp"

namespace samara {

/// The surroundings of the bodies. These move in the frame of the undisturbed flow (current and gust), which
/// coincides with the world's at time 0: there a current is no fluid motion at all, and a gust is an
/// oscillating gravity.
struct Surroundings {
    Vector3d gravity = Vector3d(0.0, 0.0, -9.81);  ///< m/s^2, world axes
    Vector3d current = Vector3d::Zero();           ///< m/s, world axes
    Gust gust = {};
    std::optional<double> ground = {};                  ///< m: the height (world z) of level ground
    std::shared_ptr<const ObstacleSet> obstacles = {};  ///< none where null
    /// The wind beyond current and gust, at places of the world; null where there is none.
    std::shared_ptr<const WindField> wind = {};
};

/// Returns the undisturbed flow's velocity (m/s) at a time (s).
Vector3d flow_velocity(const Surroundings& surroundings, double time) noexcept;

/// Returns the displacement (m) of the undisturbed flow since time 0.
Vector3d flow_displacement(const Surroundings& surroundings, double time) noexcept;

/// Returns gravity less the flow's mean acceleration between two times (m/s^2): it acts on body and fluid in
/// the flow's frame, so that the buoyancy is that of an oscillating fluid.
Vector3d apparent_gravity(const Surroundings& surroundings, double begin, double end) noexcept;

}  // namespace samara
