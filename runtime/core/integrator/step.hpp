#pragma once

#include <cstdint>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/kernel/body_state.hpp"
#include "samara/core/kernel/noise.hpp"
#include "samara/core/physics/contact_record.hpp"
#include "samara/core/physics/fluid_load.hpp"
#include "samara/core/physics/wrench.hpp"

namespace samara {

/// How the body moves from one step to the next: K (omega, v) = (l, p), the momenta of body and fluid.
///
/// l' = l x omega + p x v + tau, p' = p x omega + f (the paper's eq. 2 with its labels put right), weight
/// less buoyancy, and the loads, in one implicit solve that splits nothing: docs/theory, "The step". In still
/// fluid without gravity the energy u K u / 2 never grows, whatever the step; without loads it is kept to
/// rounding. Second order in the step. Never throws or allocates. Returns the state a time `time_step` (s)
/// later; the sampled turbulence is held.
BodyState implicit_step(const ImmersedBody& body, const Vector3d& gravity, double time_step,
                        const BodyState& state) noexcept;

/// The same while the sampled turbulence's velocity goes evenly from the state's to that of
/// `sampled_turbulence`, which is the result's; its rotation is that of `sampled_turbulence` throughout. The
/// body feels the stream's acceleration as it feels a gust's.
BodyState implicit_step(const ImmersedBody& body, const Vector3d& gravity, double time_step,
                        const BodyState& state, const SampledTurbulence& sampled_turbulence) noexcept;

/// One step of the scene: the Langevin update over the time step, then implicit steps over equal parts of it,
/// so short that the body turns by at most 0.3 rad in each, or as the limit on their number allows. `step` is
/// the number of the step in the body's flight, which began at `start` (s, of the world). A body at rest on
/// the ground takes no implicit step where nothing that acts on it changes. `external` pushes it over the
/// whole step (null: nothing does); what it meets is added to `met` (null: it is not asked for).
struct StepResult {
    BodyState state;
    int substeps = 1;
    bool wind_is_sound = true;  ///< false: a caller's wind gave what is no velocity
};
StepResult advance(const ImmersedBody& body, const Surroundings& surroundings, double start, double time_step,
                   const BodyState& state, const Noise& noise, std::uint64_t step,
                   const Wrench* external = nullptr, ContactRecord* sampled = nullptr) noexcept;

/// What the fluid would do to a body of `size` times the shape's lengths in step number `step` of a flight
/// that began at `start` (s), with the turbulence and wind of that step: the equations of docs/theory.md,
/// "Hosts". The state is in the body's own units (body_size.hpp), start and step are the world's.
/// Allocates for a body of another size in constant turbulence alone.
FluidLoad fluid_load_of(const ImmersedBody& body, double size, const Surroundings& surroundings, double start,
                        double time_step, const BodyState& state, const Noise& noise, std::uint64_t step);

}  // namespace samara
