#pragma once

#include <numbers>

namespace samara {

inline constexpr double degree = std::numbers::pi / 180.0;  ///< the angle (rad)
inline constexpr double degrees =
    180.0 / std::numbers::pi;  ///< in a radian: an angle times this is in degrees

}  // namespace samara
