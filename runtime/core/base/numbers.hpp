#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>

namespace samara {

inline constexpr double degree = std::numbers::pi / 180.0;  ///< One degree (rad).
/// Degrees in a radian: an angle (rad) times this is in degrees.
inline constexpr double degrees = 180.0 / std::numbers::pi;

/// Converts a stored index or count, which is never negative, to the type that containers take.
constexpr std::size_t as_index(std::int32_t value) noexcept {
    return static_cast<std::size_t>(value);
}

/// Bounds of the numbers of scenes and of the C interface's settings, in SI units. They are far beyond any
/// body and fluid, and keep products of the numbers within the range of doubles.
inline constexpr double largest_number = 1e30;    ///< The largest magnitude.
inline constexpr double smallest_number = 1e-60;  ///< The least value of a number that must be above zero.

}  // namespace samara
