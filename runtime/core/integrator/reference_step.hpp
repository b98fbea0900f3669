#pragma once

#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/kernel/body_state.hpp"

namespace samara {

/// What a step of the reference integrator came to.
struct ReferenceResult {
    BodyState state;
    int parts = 1;          ///< equal or unequal halves of halves of the step that were taken one by one
    bool converged = true;  ///< false: somewhere even the shortest part's equations were not solved, and
                            ///< implicit_step took that part
};

/// The shortest part of a reference step is the step over 2^reference_halvings.
inline constexpr int reference_halvings = 10;

/// The yardstick for implicit_step: the same equations, loads, gravity and seen fluid (held), by the Gauss
/// method with two stages, of the fourth order where the loads are smooth (Hairer, Lubich, Wanner, Geometric
/// Numerical Integration, 2nd ed., sections II.1.3 and IV.2).
///
/// It keeps quadratic invariants: without loads u K u / 2, |p|^2 and l . p to rounding, and with gravity the
/// total energy. In still fluid the loads never make energy. The stages are solved to rounding by a
/// simplified Newton method; where that fails, the step is halved. Never throws or allocates.
ReferenceResult reference_step(const ImmersedBody& body, const Vector3d& gravity, double time_step,
                               const BodyState& state) noexcept;

}  // namespace samara
