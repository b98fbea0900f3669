#pragma once

#include <cstddef>

#include "samara.h"
#include "samara/core/simulation/simulation.hpp"
#include "samara/core/surface/surface.hpp"

// What stands behind the opaque types of samara.h.

struct samara_body {
    samara::LoadedBody loaded;
    samara::Surface flat;  ///< order 1
};

struct samara_simulation {
    samara::Simulation core;
};

namespace samara {

/// Checks that the simulation is there and has the bodies first ... first + count - 1.
void require_bodies(const samara_simulation* simulation, std::size_t first, std::size_t count);

/// Checks besides that an array for them is there, whose stride is 0 or at least an element's `size` and a
/// multiple of its `alignment`, and returns the stride in bytes.
std::size_t checked_stride(const samara_simulation* simulation, std::size_t first, std::size_t count,
                           const void* array, const char* name, std::size_t stride, std::size_t size,
                           std::size_t alignment);

}  // namespace samara
