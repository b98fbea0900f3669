#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/kernel/kernel.hpp"

namespace samara {

/// Returns the wind's velocity (m/s, world axes) at a body beyond the undisturbed flow, at a place of the
/// flow's frame (m) and a time (s); zero where there is no wind.
Vector3d wind_velocity(const ImmersedBody& body, const Surroundings& surroundings, const Vector3d& place,
                       double time) noexcept;

/// Samples the wind of the surroundings for the bodies of one group in each step.
class BodyWind {
  public:
    /// `body` and `surroundings` must outlive this object. The simulation began at `start` (s).
    BodyWind(const ImmersedBody& body, const Surroundings& surroundings, double start,
             double time_step) noexcept
        : body_(&body), surroundings_(&surroundings), start_(start), time_step_(time_step) {}

    /// Returns the source for the kernel; null where there is no wind.
    [[nodiscard]] kernel::WindSource source() const noexcept;
    /// Returns whether all velocities of a caller's wind were finite so far.
    [[nodiscard]] bool is_sound() const noexcept { return !unsound_.load(std::memory_order_relaxed); }

  private:
    static void sample(const void* context, std::uint64_t step, std::size_t count,
                       kernel::SampledWind& sampled) noexcept;

    const ImmersedBody* body_;
    const Surroundings* surroundings_;
    double start_;
    double time_step_;
    mutable std::atomic<bool> unsound_ = false;
};

}  // namespace samara
