#pragma once

#include <cstddef>
#include <cstdint>

namespace samara {

/// A stored index or count, which is never negative, as containers take it.
constexpr std::size_t as_index(std::int32_t value) noexcept {
    return static_cast<std::size_t>(value);
}

}  // namespace samara
