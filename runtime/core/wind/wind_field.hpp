#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/kernel/kernel.hpp"
#include "samara/core/kernel/wind_constants.hpp"
#include "samara/core/wind/wind.hpp"

namespace samara {

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

/// All of a wind that shapes the motion, exactly; of a caller's that there is one. Empty where it is calm.
std::string description_of(const Wind& wind);

}  // namespace samara
