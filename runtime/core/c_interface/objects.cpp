#include "samara/core/c_interface/objects.hpp"

#include <fmt/format.h>

#include "samara/core/c_interface/guard.hpp"

namespace samara {

void require_bodies(const samara_simulation* simulation, std::size_t first, std::size_t count) {
    require(simulation, "simulation");
    const std::size_t bodies = simulation->core.size();
    if (first <= bodies && count <= bodies - first) return;
    throw StatusError(SAMARA_INVALID_ARGUMENT,
                      fmt::format("bodies {} to {} are requested, but there are {}; count from 0", first,
                                  first + count, bodies));
}

std::size_t checked_stride(const samara_simulation* simulation, std::size_t first, std::size_t count,
                           const void* array, const char* name, std::size_t stride, std::size_t size,
                           std::size_t alignment) {
    require_bodies(simulation, first, count);
    if (count > 0) require(array, name);
    if (stride == 0) return size;
    if (stride >= size && stride % alignment == 0) return stride;
    throw StatusError(SAMARA_INVALID_ARGUMENT,
                      fmt::format("stride is {}; it must be 0, or at least {} and a multiple of {} bytes",
                                  stride, size, alignment));
}

}  // namespace samara
