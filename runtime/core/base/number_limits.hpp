#pragma once

#include <string_view>

namespace samara {

/// What numbers of scenes and of the C interface's settings lie within, in SI units: far beyond any body and
/// fluid, and so that their products stay in the range of doubles.
inline constexpr double largest_number = 1e30;    ///< in magnitude
inline constexpr double smallest_number = 1e-60;  ///< of numbers that must be above zero

/// Bounds of a number, with the words for a message: "must be above 0".
struct NumberRange {
    double lowest;
    double highest;
    std::string_view words;
    bool or_zero = false;  ///< whether 0 is allowed as well

    /// Whether the number lies within; one that is none does not.
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
