#pragma once

#include <cstdint>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// The fluctuations of the fluid's velocity and rotation that one body samples, world axes (m/s, rad/s).
struct SampledTurbulence {
    Vector3d velocity = Vector3d::Zero();
    Vector3d angular_velocity = Vector3d::Zero();
};

/// The wake behind a body (docs/explanation/moving-loads.md#a-wake-that-forms).
struct Wake {
    /// The share of the transport of separated flow that has formed: 0 in fluid that was at rest, up to 1.
    double formed = 0.0;
    /// The mean direction of the body's path through the fluid in the body's axes, in which the distant past
    /// counts less: of length one where the direction has long been steady, shorter where the body swings or
    /// has just started.
    Vector3d heading = Vector3d::Zero();
};

/// A body's state in the frame that moves with the undisturbed flow (surroundings.hpp).
struct BodyState {
    Vector3d position = Vector3d::Zero();               ///< of the centre of mass (m)
    Quaterniond orientation = Quaterniond::Identity();  ///< body to world
    Vector6d velocity = Vector6d::Zero();  ///< (omega, v) of the centre of mass, body axes (rad/s, m/s)
    SampledTurbulence sampled_turbulence;
    /// The velocity's mean rate of change in the step before (rad/s^2, m/s^2), zero where there was none: it
    /// only serves as the initial guess of the next step's middle.
    Vector6d acceleration = Vector6d::Zero();
    Wake wake;
    /// Whether the body rests on the ground (ground_contact.hpp), which the step found: it must be cleared
    /// where the surroundings change, but for their gust.
    bool at_rest = false;
};

/// The most implicit steps that a step is cut into.
inline constexpr int most_substeps = 64;

/// k (m^2/s^2) and epsilon (m^2/s^3) around a body.
struct TurbulenceLevel {
    double turbulent_kinetic_energy = 0.0;
    double dissipation_rate = 0.0;
};

/// The shares of the loads of separation (docs/explanation/moving-loads.md#a-wake-that-forms): of the
/// transport, by the wake that has formed, and of the steady translation's own moment, which is there where
/// the body does not swing.
struct WakeShares {
    double transport = 1.0;
    double moment = 1.0;
};

/// The loads' matrix D, and its part that acts on the motion relative to the fluid. The rest, transport and
/// wake, acts on the rotation of the body's axes, like the Kirchhoff terms that it belongs to.
struct LoadMatrices {
    Matrix6d whole = Matrix6d::Zero();
    Matrix6d relative = Matrix6d::Zero();
};

/// Returns the begin (s) of a step, by its number, of a simulation that began at `start` (s): one sum,
/// independent of the steps before.
inline double step_time(double start, double time_step, std::uint64_t step) noexcept {
    return start + static_cast<double>(step) * time_step;
}

}  // namespace samara
