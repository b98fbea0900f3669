#pragma once

#include <cstdint>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// The fluid's turbulent velocity and rotation as one body sees them, world axes (m/s, rad/s).
struct SampledTurbulence {
    Vector3d velocity = Vector3d::Zero();
    Vector3d angular_velocity = Vector3d::Zero();
};

/// What a body has behind it in the fluid (docs/theory, "A wake that forms").
struct Wake {
    /// The share of separated flow's transport that is there: from 0 in fluid that was at rest to 1.
    double formed = 0.0;
    /// The mean direction of the way through the fluid in the body's axes, of which what is long past counts
    /// less: of length one where the fluid has long met the body from one side, shorter where the body
    /// swings or has just begun.
    Vector3d heading = Vector3d::Zero();
};

/// A body's state in the frame that moves with the undisturbed flow (surroundings.hpp).
struct BodyState {
    Vector3d position = Vector3d::Zero();               ///< of the centre of mass (m)
    Quaterniond orientation = Quaterniond::Identity();  ///< body to world
    Vector6d velocity = Vector6d::Zero();  ///< (omega, v) of the centre of mass, body axes (rad/s, m/s)
    SampledTurbulence sampled_turbulence;
    /// The velocity's mean rate of change in the step before (rad/s^2, m/s^2), zero where there was none: it
    /// only helps the next step to guess its middle.
    Vector6d acceleration = Vector6d::Zero();
    Wake wake;
    /// Whether the body rests on the ground (ground_contact.hpp), which the step found: where the
    /// surroundings change, but for their gust, it must be taken back.
    bool at_rest = false;
};

/// Into how many implicit steps a step is cut at most.
inline constexpr int most_substeps = 64;

/// k (m^2/s^2) and epsilon (m^2/s^3) around a body.
struct TurbulenceLevel {
    double turbulent_kinetic_energy = 0.0;
    double dissipation_rate = 0.0;
};

/// The shares of what separation brings (docs/theory, "A wake that forms"): of the transport, by the wake
/// that has formed, and of the steady translation's own moment, which is there where the body does not swing.
struct WakeShares {
    double transport = 1.0;
    double moment = 1.0;
};

/// The loads' matrix D, and the part of it that acts on what the body does relative to the fluid. The rest,
/// transport and wake, acts on the turning of the body's axes, as the Kirchhoff terms do to which it belongs.
struct LoadMatrices {
    Matrix6d whole = Matrix6d::Zero();
    Matrix6d relative = Matrix6d::Zero();
};

/// When a step (by its number) of a flight that began at `start` begins (s): one sum, whatever came before.
inline double step_time(double start, double time_step, std::uint64_t step) noexcept {
    return start + static_cast<double>(step) * time_step;
}

}  // namespace samara
