#pragma once

#include "internal/dynamics/immersed_body.hpp"
#include "internal/dynamics/step.hpp"
#include "internal/dynamics/surroundings.hpp"

namespace samara {

/// Level ground in the frame that moves with the undisturbed flow, at the end of a step.
struct Ground {
    double height = 0.0;                   ///< m
    Vector3d velocity = Vector3d::Zero();  ///< m/s
    Vector3d travel = Vector3d::Zero();    ///< m: how far it came in the step
    Vector3d gain = Vector3d::Zero();      ///< m/s: of its velocity in the step
};

/// The ground of the surroundings, which must have one, in the flow's frame over the step from `begin` to
/// `end` (s).
Ground ground_in_flow(const Surroundings& surroundings, double begin, double end) noexcept;

/// Coulomb's coefficient of friction between every body and the ground: chosen, not measured. Handbooks have
/// 0.25 to 0.5 for dry wood on wood.
inline constexpr double ground_friction = 0.5;

/// How far the load of a contact point stands off it, over the bounding radius: what stops a ball that rolls
/// and a body that rocks or spins. Chosen, not measured: 0.1 mm for a body of 2 cm (docs/theory.md#ground).
inline constexpr double rolling_resistance = 0.005;

/// The kinetic energy below which a body that the ground can hold comes to rest, over the work of its load
/// along the bounding radius: it moves slower than what falls a millionth of that (docs/theory.md#ground).
inline constexpr double resting_energy = 1e-6;

/// Corrects velocity and pose of a body after an implicit step of `time_step` (s), before which its state was
/// `before`, for contact with the ground: inelastic, with friction.
///
/// What stands below the ground is lifted out of it, by translation alone. Impulses (contact_impulses.hpp)
/// then leave no contact point with a velocity that takes it below the ground within the next step. They
/// never add energy: with w the velocity relative to the ground, w K w / 2 does not grow. A body whose
/// kinetic energy is below resting_energy and which the ground's impulses hold, where it stood before the
/// step, against all that the step would have done to its velocity, is at rest: it keeps its place on the
/// ground to the last bit. Never throws or allocates.
void touch_ground(const ImmersedBody& body, const Ground& ground, double time_step, const BodyState& before,
                  BodyState& state) noexcept;

/// Leaves a body at rest on the ground for a step, at the end of which the ground is as given.
void stay_on(const Ground& ground, BodyState& state) noexcept;

/// Whether a body at rest stays so: nothing that acts on it changes.
bool is_steady(const ImmersedBody& body, const Surroundings& surroundings) noexcept;

}  // namespace samara
