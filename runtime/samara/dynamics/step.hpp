#pragma once

#include <cstdint>

#include "samara/base/linear_algebra.hpp"
#include "samara/dynamics/immersed_body.hpp"
#include "samara/dynamics/langevin.hpp"
#include "samara/dynamics/noise.hpp"
#include "samara/dynamics/surroundings.hpp"

namespace samara {

/// A body's state in the frame that moves with the undisturbed flow (surroundings.hpp).
struct BodyState {
    Vector3d position = Vector3d::Zero();               ///< of the centre of mass (m)
    Quaterniond orientation = Quaterniond::Identity();  ///< body to world
    Vector6d velocity = Vector6d::Zero();  ///< (omega, v) of the centre of mass, body axes (rad/s, m/s)
    SeenFluid seen_fluid;
    /// The velocity's mean rate of change in the step before (rad/s^2, m/s^2), zero where there was none: it
    /// only helps the next step to guess its middle.
    Vector6d acceleration = Vector6d::Zero();
};

/// How the body moves from one step to the next: K (omega, v) = (l, p), the momenta of body and fluid.
///
/// l' = l x omega + p x v + tau, p' = p x omega + f (the paper's eq. 2 with its labels put right), weight
/// less buoyancy, and the loads, in one implicit solve that splits nothing: docs/theory, "The step". In still
/// fluid without gravity the energy u K u / 2 never grows, whatever the step; without loads it is kept to
/// rounding. Second order in the step. Never throws or allocates. Returns the state a time `time_step` (s)
/// later; the seen fluid is held.
BodyState implicit_step(const ImmersedBody& body, const Vector3d& gravity, double time_step,
                        const BodyState& state) noexcept;

/// One step of the scene: the Langevin update over the time step, then implicit steps over equal parts of it,
/// so short that the body turns by at most 0.3 rad in each, or as the limit on their number allows. `step` is
/// the number of the step in the body's flight, which began at `start` (s, of the world).
struct StepResult {
    BodyState state;
    int substeps = 1;
};
inline constexpr int most_substeps = 64;
StepResult advance(const ImmersedBody& body, const Surroundings& surroundings, double start, double time_step,
                   const BodyState& state, const Noise& noise, std::uint64_t step) noexcept;

/// u K u / 2 (J): the kinetic energy of body and fluid.
double kinetic_energy(const ImmersedBody& body, const BodyState& state) noexcept;

}  // namespace samara
