#pragma once

#include "samara/core/collision/obstacle_contact.hpp"
#include "samara/core/contact/contact_impulses.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/kernel/body_state.hpp"

namespace samara {

/// Level ground and obstacles in the frame that moves with the undisturbed flow, at the end of a step.
struct Ground {
    double height = 0.0;                   ///< m: of level ground; minus infinity where there is none
    Vector3d velocity = Vector3d::Zero();  ///< m/s
    Vector3d travel = Vector3d::Zero();    ///< m: how far it came in the step
    Vector3d gain = Vector3d::Zero();      ///< m/s: of its velocity in the step
    const ObstacleSet* obstacles = nullptr;
    Vector3d origin = Vector3d::Zero();  ///< m: of the world's frame
    double time = 0.0;                   ///< s, of the world

    /// Where a body with a state of the flow's frame is in the world.
    [[nodiscard]] BodyPlace in_world(const BodyState& state) const noexcept {
        return {state.position - origin, state.orientation};
    }
    /// The same at the step's beginning.
    [[nodiscard]] BodyPlace in_world_before(const BodyState& before) const noexcept {
        return {before.position + travel - origin, before.orientation};
    }
};

/// Whether there is anything that bodies can touch.
bool has_ground(const Surroundings& surroundings) noexcept;

/// What bodies touch in the surroundings, in the flow's frame over the step from `begin` to
/// `end` (s).
Ground ground_in_flow(const Surroundings& surroundings, double begin, double end) noexcept;

/// The kinetic energy below which a body that the ground can hold comes to rest, over the work of its load
/// along the bounding radius: it moves slower than what falls a millionth of that (docs/theory.md#ground).
inline constexpr double resting_energy = 1e-6;

/// Corrects velocity and pose of a body after an implicit step of `time_step` (s), before which its state was
/// `before`, for contact with the ground and with obstacles: inelastic, with friction.
///
/// What stands below the ground is lifted out of it, by translation alone, and what would pass an obstacle is
/// kept out of it (keep_out). Impulses (contact_impulses.hpp) then leave no contact point with a velocity
/// that takes it into them within the next step. They never add energy but by obstacles that move: with w the
/// velocity relative to the ground, w K w / 2 does not grow. A body whose kinetic energy is below
/// resting_energy and which impulses of what stands still hold, where it stood before the step, against all
/// that the step would have done to its velocity, is at rest: it keeps its place to the last bit. What
/// impulses do is added to `met` (null: not asked for). Never throws or allocates.
void touch_ground(const TouchingBody& body, const Ground& ground, double time_step, const BodyState& before,
                  BodyState& state, ContactRecord* record = nullptr) noexcept;

/// Leaves a body at rest on the ground for a step, at the end of which the ground is as given.
void stay_on(const Ground& ground, BodyState& state) noexcept;

/// Whether a body at rest stays so: nothing that acts on it changes, and no obstacle moves.
bool is_steady(const ImmersedBody& body, const Surroundings& surroundings) noexcept;

}  // namespace samara
