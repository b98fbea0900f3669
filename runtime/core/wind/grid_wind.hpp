#pragma once

#include "samara/core/wind/wind_grid.hpp"

namespace samara {

/// A grid's wind at one place and time.
struct GridWind {
    Vector3d velocity = Vector3d::Zero();  ///< m/s, world axes
    Matrix3d gradient = Matrix3d::Zero();  ///< 1/s: (i, j) is that of component i along axis j
    Vector3d rate = Vector3d::Zero();      ///< m/s^2: of the velocity at the place
};

/// The wind of a file at a place (m, world) and time (s).
GridWind grid_wind(const WindFile& file, const Vector3d& place, double time) noexcept;

}  // namespace samara
