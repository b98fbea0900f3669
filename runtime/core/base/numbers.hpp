#pragma once

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string_view>

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

/// Bounds of a number, with the words of a message for numbers outside them: "must be above 0".
struct NumberRange {
    double lowest;
    double highest;
    std::string_view words;
    bool or_zero = false;  ///< Whether 0 is allowed as well.

    /// Returns whether the number lies within the bounds; NaN does not.
    [[nodiscard]] constexpr bool holds(double number) const noexcept {
        return (number >= lowest && number <= highest) || (or_zero && number == 0.0);
    }
};

inline constexpr NumberRange any_number = {-largest_number, largest_number,
                                           "must be a finite number, 1e30 at most"};
inline constexpr NumberRange positive_number = {smallest_number, largest_number,
                                                "must be a finite number above 0, from 1e-60 to 1e30"};
inline constexpr NumberRange non_negative_number = {
    smallest_number, largest_number, "must be 0, or a finite number above 0, from 1e-60 to 1e30", true};

}  // namespace samara
