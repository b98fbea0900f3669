#pragma once

#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/surface/surface.hpp"

namespace samara {

/// The place of an obstacle at one time.
struct ObstaclePlace {
    Vector3d position = Vector3d::Zero();               ///< of the shape file's origin (m, world)
    Quaterniond orientation = Quaterniond::Identity();  ///< shape axes to world

    /// Returns the place in the world (m) of a point of the shape.
    [[nodiscard]] Vector3d operator()(const Vector3d& point) const { return position + orientation * point; }
};

/// The place of a moving obstacle at a given time.
struct ObstacleKey : ObstaclePlace {
    double time = 0.0;  ///< s, of the world
};

/// A solid that bodies touch and that does not react to them: a roof, a table, a hand.
struct Obstacle {
    std::string name;                      ///< for messages and exports
    Surface surface;                       ///< m, shape axes; flat triangles, closed or a sheet
    double friction = 0.5;                 ///< Coulomb's coefficient
    std::vector<ObstacleKey> keys = {{}};  ///< one where it stands still; else in ascending order of time

    /// Returns whether it moves: has more than one key.
    [[nodiscard]] bool moves() const noexcept { return keys.size() > 1; }
};

/// Returns the place of an obstacle at a time (s, of the world): between two keys linear in the position and
/// by the shortest rotation, before the first and after the last at theirs. Never throws or allocates.
ObstaclePlace place_of(const Obstacle& obstacle, double time) noexcept;

}  // namespace samara
