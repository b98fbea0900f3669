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

/// Returns the state of a body after an implicit step of `time_step` (s), by K (omega, v) = (l, p), the
/// momenta of body and fluid.
///
/// l' = l x omega + p x v + tau, p' = p x omega + f (the paper's eq. 2 with its labels corrected), weight
/// less buoyancy, and the loads, in one implicit solve without splitting:
/// docs/explanation/integrator.md#the-step. In still fluid without gravity the energy u K u / 2 never grows,
/// whatever the step; without loads it is conserved to rounding. Second order in the step. Never throws or
/// allocates. The sampled turbulence is held.
BodyState implicit_step(const ImmersedBody& body, const Vector3d& gravity, double time_step,
                        const BodyState& state) noexcept;

/// Returns the state after an implicit step in which the sampled turbulence's velocity changes evenly from
/// the state's to that of `sampled_turbulence`, which is the result's; its rotation is that of
/// `sampled_turbulence` throughout. The stream's acceleration acts on the body as that of a gust.
BodyState implicit_step(const ImmersedBody& body, const Vector3d& gravity, double time_step,
                        const BodyState& state, const SampledTurbulence& sampled_turbulence) noexcept;

/// The result of one step of a simulation: the Langevin update over the time step, then implicit steps over
/// equal parts of it, so short that the body rotates by at most 0.3 rad in each, or as the limit on their
/// number allows. `step` is the number of the step in the body's simulation, which began at `start` (s, of
/// the world). A body at rest on the ground takes no implicit step where no load on it changes. `external`
/// acts on it over the whole step (null: none); its contacts are added to `record` (null: not asked for).
struct StepResult {
    BodyState state;
    int substeps = 1;
    bool wind_is_sound = true;  ///< false: a caller's wind gave a velocity that is not finite
};
StepResult advance(const ImmersedBody& body, const Surroundings& surroundings, double start, double time_step,
                   const BodyState& state, const Noise& noise, std::uint64_t step,
                   const Wrench* external = nullptr, ContactRecord* sampled = nullptr) noexcept;

/// Returns the load of the fluid on a body of `size` times the shape's lengths in step number `step` of a
/// simulation that began at `start` (s), with the turbulence and wind of that step: the equations of
/// docs/explanation/integrator.md#host-engines. The state is in the body's own units (body_size.hpp), start
/// and step are the world's. Allocates only for a body of another size in constant turbulence.
FluidLoad fluid_load_of(const ImmersedBody& body, double size, const Surroundings& surroundings, double start,
                        double time_step, const BodyState& state, const Noise& noise, std::uint64_t step);

/// Returns the parts of that load, of a body that moved with the acceleration of its last step.
FluidForces fluid_forces_of(const ImmersedBody& body, double size, const Surroundings& surroundings,
                            double start, double time_step, const BodyState& state, const Noise& noise,
                            std::uint64_t step);

}  // namespace samara
