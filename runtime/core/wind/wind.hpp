#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/wind/wind_grid.hpp"

namespace samara {

/// The growth of the mean wind with the height over the ground, from 0 there to the whole at `height`.
struct WindProfile {
    /// The law of growth: ln((z + z0)/z0) (Richards and Hoxey, J. Wind Eng. Ind. Aerodyn. 46-47, 1993), or
    /// z^exponent.
    enum class Law { logarithmic, power };
    Law law = Law::logarithmic;  ///< which of the two
    double roughness = 0.03;     ///< m: z0 of the logarithmic law; open grass
    double exponent = 0.14;      ///< of the power law
    double height = 10.0;        ///< m over the ground: the height of the given velocity
    double ground = 0.0;         ///< m: world z below which there is no wind

    /// Compares member by member.
    bool operator==(const WindProfile&) const = default;
};

/// The fall of the whole wind towards ground and obstacles, where the air stands: from all of it at `height`
/// to none on the surface, as ln(1 + d/z0) over the distance d.
struct WindSurfaceLayer {
    double height = 0.1;      ///< m from the surface; 0: the full wind reaches it
    double roughness = 1e-3;  ///< m: z0; boards, tiles

    /// Returns the share of the wind at a distance (m) from the surface, 0 to 1.
    [[nodiscard]] double share_at(double distance) const noexcept;
    /// Compares member by member.
    bool operator==(const WindSurfaceLayer&) const = default;
};

/// Gusts as frozen turbulence that drifts with current and mean wind: homogeneous, isotropic, free of
/// divergence.
struct WindGusts {
    /// The spectrum of the velocity along a line, with sigma = rms and L = length: von Karman's (2 L/pi)
    /// sigma^2/(1 + (1.339 k L)^2)^(5/6), or Kaimal's (2 L/pi) sigma^2/(1 + 3 k L/pi)^(5/3).
    enum class Spectrum { von_karman, kaimal };
    Spectrum spectrum = Spectrum::von_karman;  ///< which of the two
    double rms = 0.0;                          ///< m/s, of each component
    double length = 1.0;                       ///< m: the integral length along the velocity
    std::optional<std::uint64_t> seed = {};    ///< of the waves; the simulation's own where absent
    /// The number of bands of wave numbers from 0.1/length to 100/length, evenly by their logarithm; three
    /// waves each.
    int bands = 32;

    /// Compares member by member.
    bool operator==(const WindGusts&) const = default;
};

/// A straight, infinite vortex.
struct WindVortex {
    /// The core: Lamb and Oseen's, G/(2 pi r) (1 - exp(-r^2/core^2)), or Rankine's, in solid rotation.
    enum class Core { lamb_oseen, rankine };
    Core type = Core::lamb_oseen;          ///< which of the two
    Vector3d position = Vector3d::Zero();  ///< m: a point of its axis, at time 0
    Vector3d axis = Vector3d::UnitZ();     ///< unit vector: the axis of rotation
    double circulation = 0.0;              ///< m^2/s: G
    double core = 1.0;                     ///< m: the core's radius
    Vector3d velocity = Vector3d::Zero();  ///< m/s: of the axis

    /// Compares member by member.
    bool operator==(const WindVortex&) const = default;
};

/// A round turbulent jet, free of divergence: before the fan its speed is a bell over the distance from the
/// axis, which widens by 0.107 a metre (Fischer et al., Mixing in Inland and Coastal Waters, 1979) and keeps
/// its momentum; behind it the air is drawn in over one diameter.
struct WindFan {
    Vector3d position = Vector3d::Zero();    ///< m: the middle of the fan
    Vector3d direction = Vector3d::UnitX();  ///< unit vector: the direction of the flow
    double diameter = 0.4;                   ///< m
    double speed = 0.0;  ///< m/s on the axis at the fan; far away 6.6 diameters/distance of it

    /// Compares member by member.
    bool operator==(const WindFan&) const = default;
};

/// A wind that the caller computes. Fills `velocities` (x, y, z; m/s, world axes) at `count` places (x, y, z;
/// m, world) at a time (s). May be called by several threads at once, must not throw, and must return the
/// same for the same arguments.
using WindFunction = void (*)(void* context, double time, std::size_t count, const double* places,
                              double* velocities);

/// The wind beside the uniform current and gust: the sum of its parts.
struct Wind {
    Vector3d velocity = Vector3d::Zero();     ///< m/s: alone equivalent to a current
    std::optional<WindProfile> profile = {};  ///< of `velocity`, which must then be level
    std::optional<WindGusts> gusts = {};      ///< none where absent
    std::vector<WindVortex> vortices = {};    ///< any number
    std::vector<WindFan> fans = {};           ///< any number
    std::optional<WindFile> file = {};        ///< none where absent
    WindFunction function = nullptr;          ///< none where null
    void* function_context = nullptr;         ///< passed to `function`
    /// Near surfaces; absent: the default, but for a uniform and steady wind, which is a current.
    std::optional<WindSurfaceLayer> surface_layer = {};

    /// Returns whether it is more than a uniform and steady velocity.
    [[nodiscard]] bool is_field() const {
        return surface_layer || profile || gusts || !vortices.empty() || !fans.empty() || file ||
               function != nullptr;
    }
    /// Returns this wind with the seed for gusts that have none.
    [[nodiscard]] Wind seeded(std::uint64_t seed) const {
        Wind wind = *this;
        if (wind.gusts && !wind.gusts->seed) wind.gusts->seed = seed;
        return wind;
    }
    /// Returns whether there is no wind.
    [[nodiscard]] bool is_calm() const { return !is_field() && velocity.isZero(0.0); }
    /// Compares member by member.
    bool operator==(const Wind&) const = default;
};

}  // namespace samara
