#pragma once

#include <cstdint>

#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/kernel/body_state.hpp"
#include "samara/core/kernel/noise.hpp"
#include "samara/core/physics/fluid_load.hpp"

namespace samara {

/// What the fluid would do to a body of `size` times the shape's lengths in step number `step` of a flight
/// that began at `start` (s), with the turbulence and wind of that step: the equations of docs/theory.md,
/// "Hosts". The state is in the body's own units (body_size.hpp), start and step are the world's.
/// Allocates for a body of another size in constant turbulence alone.
FluidLoad fluid_load_of(const ImmersedBody& body, double size, const Surroundings& surroundings, double start,
                        double time_step, const BodyState& state, const Noise& noise, std::uint64_t step);

}  // namespace samara
