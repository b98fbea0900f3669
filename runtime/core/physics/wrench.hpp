#pragma once

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// A force on a body's centre of mass (N, or as an impulse N s) and a moment about it (N m, N m s), world
/// axes.
struct Wrench {
    Vector3d force = Vector3d::Zero();
    Vector3d moment = Vector3d::Zero();

    /// Whether there is nothing of either.
    [[nodiscard]] bool is_zero() const noexcept { return force.isZero(0.0) && moment.isZero(0.0); }
    /// Member by member.
    bool operator==(const Wrench&) const = default;
    /// Of a time (s) over another, as an impulse of a force; or of a number.
    friend Wrench operator*(double factor, const Wrench& wrench) {
        return {factor * wrench.force, factor * wrench.moment};
    }
    /// Both together.
    friend Wrench operator+(const Wrench& a, const Wrench& b) {
        return {a.force + b.force, a.moment + b.moment};
    }
};

}  // namespace samara
