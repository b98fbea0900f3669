#pragma once

#include "samara/core/collision/obstacle_contact.hpp"
#include "samara/core/contact/body_impulses.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/kernel/body_state.hpp"
#include "samara/core/kernel/kernel.hpp"

namespace samara {

/// Level ground and obstacles in the frame that moves with the undisturbed flow, at the end of a step.
struct Ground {
    double height = 0.0;                   ///< m: of level ground; minus infinity where there is none
    Vector3d velocity = Vector3d::Zero();  ///< m/s
    Vector3d travel = Vector3d::Zero();    ///< m: its displacement in the step
    Vector3d gain = Vector3d::Zero();      ///< m/s: the change of its velocity in the step
    const ObstacleSet* obstacles = nullptr;
    Vector3d origin = Vector3d::Zero();  ///< m: of the world's frame
    double time = 0.0;                   ///< s, of the world

    /// Returns the place in the world of a body with a state of the flow's frame.
    [[nodiscard]] BodyPlace in_world(const BodyState& state) const noexcept {
        return {state.position - origin, state.orientation};
    }
    /// Returns the place in the world, at the beginning of the step, of a body with a state of the flow's
    /// frame.
    [[nodiscard]] BodyPlace in_world_before(const BodyState& before) const noexcept {
        return {before.position + travel - origin, before.orientation};
    }
};

/// Returns whether there is anything that bodies can touch.
bool has_ground(const Surroundings& surroundings) noexcept;

/// Returns what bodies can touch in the surroundings, in the flow's frame over the step from `begin` to `end`
/// (s).
Ground ground_in_flow(const Surroundings& surroundings, double begin, double end) noexcept;

/// The kinetic energy below which a body that the ground can hold comes to rest, relative to the work of its
/// load along the bounding radius: a body that has fallen a millionth of that radius is faster
/// (docs/explanation/integrator.md#ground).
inline constexpr double resting_energy = 1e-6;

/// Corrects velocity and pose of a body after an implicit step of `time_step` (s), before which its state was
/// `before`, for contact with the ground and with obstacles: inelastic, with friction.
///
/// A body below the ground is lifted out of it, by translation alone, and kept from passing through obstacles
/// (keep_out). Impulses (body_impulses.hpp) then leave no contact point with a velocity that takes it into
/// them within the next step. They never add energy but by moving obstacles: with w the velocity relative to
/// the ground, w K w / 2 does not grow otherwise. A body is at rest where its kinetic energy is below
/// resting_energy and impulses of standing surfaces hold it, where it stood before the step, against the
/// whole change of its velocity in the step: it keeps its place to the last bit. Impulses are added to
/// `record` (null: not asked for). Never throws or allocates.
void touch_ground(const TouchingBody& body, const Ground& ground, double time_step, const BodyState& before,
                  BodyState& state, ContactRecord* record = nullptr) noexcept;

/// Keeps a body at rest on the ground for a step, at the end of which the ground is as given.
void keep_on_ground(const Ground& ground, BodyState& state) noexcept;

/// Returns when a body that is at rest must be judged anew: not at all where no load on it changes; every 20
/// ms in a wind or an oscillating flow; in each step where an obstacle moves or the turbulence is constant.
kernel::RestJudgement judgement_of_rest(const ImmersedBody& body, const Surroundings& surroundings,
                                        double time_step) noexcept;

}  // namespace samara
