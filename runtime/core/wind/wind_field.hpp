#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/kernel/kernel.hpp"
#include "samara/core/kernel/wind_constants.hpp"
#include "samara/core/wind/wind.hpp"
#include "samara/core/wind/wind_grid.hpp"

namespace samara {

/// The sampling of a caller's wind, which gives velocities alone: at six places around a body and two times.
struct WindSpan {
    double reach = 0.0;     ///< m: the distance of the places from the middle
    double duration = 0.0;  ///< s: the time between the two
};

/// A wind that is not uniform and steady, prepared for the steps (docs/explanation/noise-and-wake.md#wind),
/// as it is far from surfaces.
class WindField {
  public:
    /// Prepares the wind. `current` (m/s): the gusts drift with it and with the wind's own velocity.
    WindField(const Wind& wind, const Vector3d& current);

    /// Fills the wind in the first `count` lanes at a time (s). A caller's velocity that is not finite, or
    /// beyond 1e30, is replaced by zero, and false returned.
    bool blow(double time, const WindSpan& span, std::size_t count, WindBlock& block) const noexcept;

    /// Returns the fall of the wind towards surfaces, which `blow` leaves out.
    [[nodiscard]] const WindSurfaceLayer& surface_layer() const noexcept { return surface_layer_; }
    /// Returns the constants of the formulas.
    [[nodiscard]] const WindConstants& constants() const noexcept { return constants_; }

  private:
    void add_file(double time, std::size_t count, WindBlock& block) const noexcept;
    bool add_function(double time, const WindSpan& span, std::size_t count, WindBlock& block) const noexcept;

    WindConstants constants_;
    Vector3d uniform_ = Vector3d::Zero();  ///< m/s: the velocity without a profile
    WindSurfaceLayer surface_layer_;
    std::optional<WindFile> file_;
    WindFunction function_;
    void* context_;
};

/// Returns a description of all of a wind that determines the motion, exactly; of a caller's wind only that
/// there is one. Empty where it is calm.
std::string description_of(const Wind& wind);

/// Returns the energy spectrum (m^3/s^2) at the wave number k (rad/m) of the isotropic, divergence-free field
/// whose spectrum along a line is F (WindGusts::Spectrum): k^3/2 d/dk (F'/k) (Pope, Turbulent Flows, 2000,
/// eq. 6.217).
double energy_spectrum(const WindGusts& gusts, double k) noexcept;

/// Returns the waves of the gusts, three of each band at right angles to each other, so that every component
/// of the velocity has the same variance in every band, rms^2 in all. The first band holds the energy below
/// it; the energy above the last, 6 % of von Karman's and 10 % of Kaimal's, is spread over all.
std::vector<GustWave> gust_waves(const WindGusts& gusts);

/// The wind of a grid at one place and time.
struct GridWind {
    Vector3d velocity = Vector3d::Zero();  ///< m/s, world axes
    Matrix3d gradient = Matrix3d::Zero();  ///< 1/s: (i, j) is the derivative of component i along axis j
    Vector3d rate = Vector3d::Zero();      ///< m/s^2: the rate of change of the velocity at the place
};

/// Returns the wind of a file at a place (m, world) and time (s).
GridWind grid_wind(const WindFile& file, const Vector3d& place, double time) noexcept;

}  // namespace samara
