#pragma once

#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/kernel/body_state.hpp"
#include "samara/core/physics/pose.hpp"

namespace samara {

/// Returns the state, in the shape's own lengths and times, of a body of that size with this state in the
/// world's. A body of `size` times the shape's lengths and of its density moves, in the same fluid, like the
/// shape itself with all lengths over size, all times over size^2 and gravity times size^3: Reynolds numbers,
/// Froude numbers and ratios of mass are the same (docs/explanation/moving-loads.md#sizes). So one prepared
/// body serves all sizes.
BodyState in_own_units(const BodyState& state, double size) noexcept;
/// Returns the state in the world's lengths and times: the inverse of in_own_units().
BodyState in_world_units(const BodyState& state, double size) noexcept;

/// Returns the pose of a body of that size in the shape's own lengths and times.
Pose in_own_units(const Pose& pose, double size) noexcept;

/// Returns the touching body at that size, in metres and kilograms.
TouchingBody touching_body(const TouchingBody& body, double size);

}  // namespace samara
