#pragma once

#include <vector>

#include "samara/core/kernel/wind_constants.hpp"
#include "samara/core/wind/wind.hpp"

namespace samara {

/// The energy spectrum (m^3/s^2) at the wave number k (rad/m) of the isotropic, divergence-free field whose
/// spectrum along a line is F (WindGusts::Spectrum): k^3/2 d/dk (F'/k) (Pope, Turbulent Flows, 2000, eq.
/// 6.217).
double energy_spectrum(const WindGusts& gusts, double k) noexcept;

/// The waves of the gusts, three of each band at right angles to each other, so that every component of the
/// velocity has the same variance in every one of them, rms^2 in all. The first band holds what lies below
/// it; what lies above the last, 6 % of von Karman's energy and 10 % of Kaimal's, is spread over all.
std::vector<GustWave> gust_waves(const WindGusts& gusts);

}  // namespace samara
