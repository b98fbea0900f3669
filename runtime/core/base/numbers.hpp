#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>

namespace samara {

inline constexpr double degree = std::numbers::pi / 180.0;  ///< the angle (rad)
inline constexpr double degrees =
    180.0 / std::numbers::pi;  ///< in a radian: an angle times this is in degrees

/// A stored index or count, which is never negative, as containers take it.
constexpr std::size_t as_index(std::int32_t value) noexcept {
    return static_cast<std::size_t>(value);
}

/// What numbers of scenes and of the C interface's settings lie within, in SI units: far beyond any body and
/// fluid, and so that their products stay in the range of doubles.
inline constexpr double largest_number = 1e30;    ///< in magnitude
inline constexpr double smallest_number = 1e-60;  ///< of numbers that must be above zero

}  // namespace samara
