#pragma once

#include <cstdint>

#include "internal/dynamics/immersed_body.hpp"
#include "internal/dynamics/surroundings.hpp"
#include "internal/kernel/body_state.hpp"
#include "internal/kernel/noise.hpp"
#include "samara/physics/fluid_load.hpp"

namespace samara {

/// What the fluid would do to a body of the shape's own size in step number `step` of a flight that began at
/// `start` (s), with the turbulence and wind of that step: the equations of docs/theory.md, "For hosts that
/// integrate bodies themselves". Never throws or allocates.
FluidLoad fluid_load_of(const ImmersedBody& body, const Surroundings& surroundings, double start,
                        double time_step, const BodyState& state, const Noise& noise,
                        std::uint64_t step) noexcept;

}  // namespace samara
