#pragma once

namespace samara {

/// What numbers of scenes and of the C interface's settings lie within, in SI units: far beyond any body and
/// fluid, and so that their products stay in the range of doubles.
inline constexpr double largest_number = 1e30;    ///< in magnitude
inline constexpr double smallest_number = 1e-60;  ///< of numbers that must be above zero

}  // namespace samara
