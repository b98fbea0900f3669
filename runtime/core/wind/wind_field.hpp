#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

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

}  // namespace samara
