#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/kernel/kernel.hpp"
#include "samara/core/kernel/wind_constants.hpp"
#include "samara/core/wind/wind.hpp"

namespace samara {

struct Surroundings;

/// How a body looks at a caller's wind, which gives velocities alone: at six places around it and two times.
struct WindSpan {
    double reach = 0.0;     ///< m: how far the places are from the middle
    double duration = 0.0;  ///< s: how far the times are apart
};

/// A wind that is no uniform and steady velocity, made ready for the steps (docs/theory, "Wind").
class WindField {
  public:
    /// `current`: with which the gusts drift, beside the wind's own velocity (m/s).
    WindField(const Wind& wind, const Vector3d& current);

    /// Fills the wind in the first `count` lanes at a time (s). Where a caller's wind gives a velocity that
    /// is not finite, or beyond 1e30, that one is taken for zero, and false returned.
    bool blow(double time, const WindSpan& span, std::size_t count, WindBlock& block) const noexcept;

    /// What the formulas are given.
    [[nodiscard]] const WindConstants& constants() const noexcept { return constants_; }

  private:
    void add_file(double time, std::size_t count, WindBlock& block) const noexcept;
    bool add_function(double time, const WindSpan& span, std::size_t count, WindBlock& block) const noexcept;

    WindConstants constants_;
    std::optional<WindFile> file_;
    WindFunction function_;
    void* context_;
};

/// The wind's velocity (m/s, world axes) beyond the undisturbed flow that a body meets at a place of the
/// flow's frame (m) and a time (s); zero where there is none.
Vector3d wind_velocity(const ImmersedBody& body, const Surroundings& surroundings, const Vector3d& place,
                       double time) noexcept;

/// What bodies of one kind meet of the wind of their surroundings in each step.
class WindMeeting {
  public:
    /// Body and surroundings must outlive the meeting. The flight began at `start` (s).
    WindMeeting(const ImmersedBody& body, const Surroundings& surroundings, double start,
                double time_step) noexcept
        : body_(&body), surroundings_(&surroundings), start_(start), time_step_(time_step) {}

    /// Null where there is no wind.
    [[nodiscard]] kernel::WindSource source() const noexcept;
    /// Whether a caller's wind gave nothing but numbers so far.
    [[nodiscard]] bool is_sound() const noexcept { return !unsound_.load(std::memory_order_relaxed); }

  private:
    static void meet(const void* context, std::uint64_t step, std::size_t count,
                     kernel::MetWind& met) noexcept;

    const ImmersedBody* body_;
    const Surroundings* surroundings_;
    double start_;
    double time_step_;
    mutable std::atomic<bool> unsound_ = false;
};

/// All of a wind that shapes the motion, exactly; of a caller's that there is one. Empty where it is calm.
std::string description_of(const Wind& wind);

/// The energy spectrum (m^3/s^2) at the wave number k (rad/m) of the isotropic, divergence-free field whose
/// spectrum along a line is F (WindGusts::Spectrum): k^3/2 d/dk (F'/k) (Pope, Turbulent Flows, 2000, eq.
/// 6.217).
double energy_spectrum(const WindGusts& gusts, double k) noexcept;

/// The waves of the gusts, three of each band at right angles to each other, so that every component of the
/// velocity has the same variance in every one of them, rms^2 in all. The first band holds what lies below
/// it; what lies above the last, 6 % of von Karman's energy and 10 % of Kaimal's, is spread over all.
std::vector<GustWave> gust_waves(const WindGusts& gusts);

}  // namespace samara
