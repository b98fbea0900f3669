#pragma once

#include <array>
#include <utility>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/physics/wrench.hpp"

namespace samara {

/// The fluid's load on a body in its next step, for a host that integrates the body itself. World axes, at
/// the centre of mass; six-vectors are angular, then linear.
///
/// With M the body's own inertia (6x6), g its own wrench (weight, gyroscopic moment, joints, contacts), a its
/// acceleration and h the step, M a = g + wrench - added_inertia a. The wrench holds for the velocity at the
/// step's begin; damping is the decrease of the wrench per velocity, so that
///
///     (M + added_inertia + h damping) a = g + wrench
///
/// is stable however stiff the drag is, and of first order. A host that cannot take the added inertia into
/// its own, but gives -added_inertia a with the acceleration of the step before, diverges wherever it is
/// larger than M.
struct FluidLoad {
    Vector6d wrench = Vector6d::Zero();         ///< N m, N: of the fluid at the body's present velocity
    Matrix6d added_inertia = Matrix6d::Zero();  ///< kg m^2, kg m, kg; symmetric, positive semidefinite
    Matrix6d damping = Matrix6d::Zero();        ///< N m s, N s, N s/m; its symmetric part is never negative
};

/// The fluid's forces on a body as it moves, and their moments about the centre of mass; world axes. Together
/// with weight, pushes and contacts they are what moves the body's own mass.
struct FluidForces {
    Wrench buoyancy;  ///< of the displaced fluid, in an accelerating flow too
    Wrench inertia;   ///< of the fluid that the body accelerates and carries along: its added mass
    Wrench drag;      ///< the part of the steady and moving loads against the relative velocity; no moment
    Wrench lift;      ///< the part of these loads across it, and their whole moment
    Wrench noise;     ///< the difference that the turbulence makes to all of them

    /// Returns the forces between these and others, at a fraction from 0 to 1.
    [[nodiscard]] FluidForces towards(const FluidForces& other, double fraction) const {
        const auto between = [&](const Wrench& a, const Wrench& b) {
            return (1.0 - fraction) * a + fraction * b;
        };
        return {between(buoyancy, other.buoyancy), between(inertia, other.inertia), between(drag, other.drag),
                between(lift, other.lift), between(noise, other.noise)};
    }
    /// Returns the sum.
    [[nodiscard]] Wrench total() const { return buoyancy + inertia + drag + lift + noise; }
};

/// The parts of FluidForces in order, with their names in files and interfaces.
inline constexpr std::array parts_of_fluid_forces = {
    std::pair{"buoyancy", &FluidForces::buoyancy}, std::pair{"inertia", &FluidForces::inertia},
    std::pair{"drag", &FluidForces::drag}, std::pair{"lift", &FluidForces::lift},
    std::pair{"noise", &FluidForces::noise}};

}  // namespace samara
