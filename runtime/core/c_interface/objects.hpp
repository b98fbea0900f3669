#pragma once

#include <cstddef>

#include "samara.h"
#include "samara/core/simulation/simulation.hpp"
#include "samara/core/surface/surface.hpp"

// The types behind the opaque types of samara.h.

struct samara_body {
    samara::LoadedBody loaded;
    samara::Surface flat;  ///< order 1
};

struct samara_simulation {
    samara::Simulation core;
};

namespace samara {

/// Throws StatusError of SAMARA_INVALID_ARGUMENT where the simulation is null or lacks one of the bodies
/// first ... first + count - 1.
void require_bodies(const samara_simulation* simulation, std::size_t first, std::size_t count);

/// Returns the stride (bytes) of an array for these bodies. Throws StatusError of SAMARA_INVALID_ARGUMENT as
/// require_bodies() does, where the array is null, and where the stride is neither 0 nor at least an
/// element's `size` and a multiple of its `alignment`.
std::size_t checked_stride(const samara_simulation* simulation, std::size_t first, std::size_t count,
                           const void* array, const char* name, std::size_t stride, std::size_t size,
                           std::size_t alignment);

}  // namespace samara
