#pragma once

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// A force on a body's centre of mass (N, or as an impulse N s) and a moment about it (N m, N m s), world
/// axes.
struct Wrench {
    Vector3d force = Vector3d::Zero();   ///< N, or N s
    Vector3d moment = Vector3d::Zero();  ///< N m, or N m s, about the centre of mass

    /// Returns whether force and moment are zero.
    [[nodiscard]] bool is_zero() const noexcept { return force.isZero(0.0) && moment.isZero(0.0); }
    /// Compares member by member.
    bool operator==(const Wrench&) const = default;
    /// Scales a wrench, such as a force by a duration (s) to an impulse.
    friend Wrench operator*(double factor, const Wrench& wrench) {
        return {factor * wrench.force, factor * wrench.moment};
    }
    /// Adds two wrenches.
    friend Wrench operator+(const Wrench& a, const Wrench& b) {
        return {a.force + b.force, a.moment + b.moment};
    }
};

}  // namespace samara
