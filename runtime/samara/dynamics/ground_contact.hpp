#pragma once

#include "samara/dynamics/immersed_body.hpp"
#include "samara/dynamics/step.hpp"
#include "samara/dynamics/surroundings.hpp"

namespace samara {

/// Level ground in the frame that moves with the undisturbed flow, at the end of a step.
struct Ground {
    double height = 0.0;                   ///< m
    Vector3d velocity = Vector3d::Zero();  ///< m/s
    Vector3d travel = Vector3d::Zero();    ///< m: how far it came in the step
};

/// The ground of the surroundings, which must have one, in the flow's frame over the step from `begin` to
/// `end` (s).
Ground ground_in_flow(const Surroundings& surroundings, double begin, double end) noexcept;

/// Coulomb's coefficient of friction between every body and the ground.
inline constexpr double ground_friction = 0.5;

/// How far the weight of a round side stands off the point it touches the ground with, over the bounding
/// radius: what stops a ball that rolls or spins.
inline constexpr double rolling_resistance = 0.005;

/// Corrects velocity and pose of a body after an implicit step of `time_step` (s), before which its state was
/// `before`, for contact with the ground: inelastic, with friction.
///
/// What stands below the ground is lifted out of it, by translation alone. Impulses at up to nine contact
/// points then leave no point with a velocity that takes it below the ground within the next step; friction
/// stays within Coulomb's cone. The impulses never add energy: with w the velocity relative to the ground, w
/// K w / 2 does not grow. A body that lay still and that the impulses bring to rest again keeps its place on
/// the ground to the last bit. Never throws or allocates.
///
/// Projected Gauss-Seidel on the impulses: Erleben, Velocity-based shock propagation for multibody dynamics
/// animation, ACM Transactions on Graphics 26(2), 2007, section 3; the inertia here is K, the fluid's
/// included.
void touch_ground(const ImmersedBody& body, const Ground& ground, double time_step, const BodyState& before,
                  BodyState& state) noexcept;

}  // namespace samara
