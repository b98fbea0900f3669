#pragma once

#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/kernel/body_state.hpp"
#include "samara/core/physics/pose.hpp"

namespace samara {

/// Returns the state, in the shape's own lengths and times, of a body of that size with this state in the
/// world's. A body of `size` times the shape's lengths and of its density moves, in the same fluid, like the
/// shape itself with all lengths over size, all times over size^2 and gravity times size^3: Reynolds numbers,
/// Froude numbers and ratios of mass are the same (docs/explanation/moving-loads.md#sizes). So one prepared
/// body serves all sizes. A body that keeps its thickness has own_share() of its own mass and inertia.
BodyState in_own_units(const BodyState& state, double size) noexcept;
/// Returns the state in the world's lengths and times: the inverse of in_own_units().
BodyState in_world_units(const BodyState& state, double size) noexcept;

/// Returns the pose of a body of that size in the shape's own lengths and times.
Pose in_own_units(const Pose& pose, double size) noexcept;

/// Returns the mass of a body of that size over what it is at the shape's density: 1/size where sizes keep
/// the thickness.
double own_share(const ImmersedBody& body, double size) noexcept;

/// Returns the inertia K of a body of that size about the centre of mass, in the shape's own lengths and
/// units of mass.
Matrix6d inertia_of_size(const ImmersedBody& body, double size);

/// Returns the touching body at that size, in metres and kilograms.
TouchingBody touching_body(const ImmersedBody& body, double size);

}  // namespace samara
