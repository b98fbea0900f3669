#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "samara/scene/scene.hpp"

namespace samara {

/// The ranges within which a search varies the launch of a body about that of the scene.
struct LaunchRanges {
    std::optional<std::array<double, 2>> speed = {};  ///< m/s: the lowest and the highest
    double direction_within = 0.0;                    ///< rad: the velocity's largest angle from the scene's
    double orientation_within = 0.0;                  ///< rad: the largest rotation, about a random axis
    Vector3d position_within = Vector3d::Zero();      ///< m: the largest shift along each axis

    /// Returns whether any range is given.
    [[nodiscard]] bool any() const noexcept {
        return speed || direction_within > 0.0 || orientation_within > 0.0 || !position_within.isZero(0.0);
    }
};

/// What a launch has in place of the scene's values. The numbers have six digits, so that a scene file that
/// has them as they are printed gives the same motion.
struct Launch {
    std::optional<Vector3d> position;  ///< m, world: `position` of the scene's body
    std::optional<std::array<double, 4>>
        orientation;                   ///< w, x, y, z: its `orientation`, not quite of length 1
    std::optional<Vector3d> velocity;  ///< m/s, world: its `velocity`

    /// Puts the values into a body.
    void apply(SceneBody& body) const;
};

/// Throws Error, with the remedy, where the body does not have what the ranges vary: a velocity, or a
/// position of its own.
void require_launch(const LaunchRanges& ranges, const SceneBody& body);

/// Returns a launch that is drawn for a seed: the speed uniform between its bounds, the direction uniform in
/// its cone, the rotation by a uniform angle about a random axis, the position uniform in its box.
Launch drawn_launch(const LaunchRanges& ranges, const SceneBody& body, std::uint64_t seed);

}  // namespace samara
