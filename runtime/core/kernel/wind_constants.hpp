#pragma once

#include <cstddef>
#include <vector>

#include "samara/core/kernel/triple.hpp"

namespace samara {

/// One wave of the gusts: u = a cos(2 pi p) + b sin(2 pi p), p = k.x + phase, a and b at right angles to k.
struct GustWave {
    Triple<double> wave_number;  ///< k: revolutions per metre
    Triple<double> a, b;         ///< m/s
    double phase;                ///< revolutions
};

/// The constants of a vortex: u = g(|d|^2) axis x d, with the vector d from its axis.
struct VortexConstants {
    bool rankine;
    Triple<double> position, axis, velocity;
    double strength;        ///< circulation/2 pi (m^2/s)
    double core_square;     ///< m^2
    double inverse_square;  ///< 1/core^2
};

/// The constants of a fan, whose velocity is from the stream function of a bell of half-width `width` (m) at
/// the fan.
struct FanConstants {
    Triple<double> position, direction;
    double width;      ///< m
    double half_flow;  ///< speed width/2 (m^2/s)
    double intake;     ///< m: the distance over which the air is drawn in
};

/// The constants of a wind's formulas (docs/explanation/noise-and-wake.md#wind).
struct WindConstants {
    enum class Profile { none, logarithmic, power };
    Profile profile = Profile::none;
    Triple<double> profile_velocity = {};  ///< m/s at the profile's height
    double ground = 0.0;                   ///< m
    double inverse_scale = 0.0;            ///< 1/z0, or 1/height
    double exponent = 0.0;                 ///< 1/ln((height + z0)/z0), or the power law's
    double lowest = 0.0;                   ///< m: below it the power law is a straight line
    Triple<double> drift = {};             ///< m/s: of the gusts' waves
    std::vector<GustWave> waves = {};
    std::vector<VortexConstants> vortices = {};
    std::vector<FanConstants> fans = {};
};

/// Places, and the wind there: each number is a row of lanes.
struct alignas(64) WindBlock {
    static constexpr std::size_t size = 16;
    double place[3][size];     ///< m, world
    double velocity[3][size];  ///< m/s
    double gradient[9][size];  ///< 1/s: du_i/dx_j by rows
    double rate[3][size];      ///< m/s^2: du/dt in place
};

namespace kernel {

/// Computes the wind at a time (s) in the first `count` lanes: for each the same as alone, to the last bit,
/// on every instruction set.
void blow(const WindConstants& wind, double time, std::size_t count, WindBlock& block) noexcept;

}  // namespace kernel
}  // namespace samara
