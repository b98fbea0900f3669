#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "samara/core/dynamics/loads.hpp"
#include "support/known_bodies.hpp"
#include "support/reference_step.hpp"

// The terms of the loads of a rotating body, written out as docs/explanation/moving-loads.md has them:
// moment about the centroid (N m) and force (N), body axes, of a motion (rad/s, m/s).

namespace samara::test {

inline Vector3d random_vector(std::mt19937& generator) {
    std::normal_distribution<double> normal;
    const double x = normal(generator);
    const double y = normal(generator);
    return {x, y, normal(generator)};
}

/// Speeds about 0.2 m/s; angular velocities of a thousandth to a thousand radians a second, as i goes on.
inline Vector6d random_motion(std::mt19937& generator, int i) {
    Vector6d motion;
    motion << std::pow(10.0, i % 7 - 3) * random_vector(generator), 0.2 * random_vector(generator);
    return motion;
}

inline Vector6d motion_of(const Vector3d& omega, const Vector3d& velocity) {
    Vector6d motion;
    motion << omega, velocity;
    return motion;
}

/// Moment about the centroid and force.
inline Vector6d loads_at(const ImmersedBody& body, const Vector6d& motion) {
    return -load_matrix(body, motion) * motion;
}

/// The body without dynamic coefficients; also without tables' loads where `table` is false, so that no load
/// but the moment of creeping rotation is left.
inline ImmersedBody bare(ImmersedBody body, bool table) {
    const double half_length = body.dynamic.half_length;
    body.dynamic = {};
    body.dynamic.half_length = half_length;
    body.roll_drag.setZero();
    if (!table) {
        body.loads = Loads::coefficients;
        body.coefficients.drag_coefficient = 0.0;
        body.coefficients.reference_area = 1e-3;
    }
    prepare(body);
    return body;
}

/// A motion and what the formulas need of it.
struct Motion {
    const ImmersedBody& body;
    Vector3d omega, v;
    double tip, combined;

    Motion(const ImmersedBody& given, const Vector6d& motion)
        : body(given),
          omega(motion.head<3>()),
          v(motion.tail<3>()),
          tip(given.dynamic.half_length * omega.norm()),
          combined(std::hypot(v.norm(), tip)) {}
};

inline Vector6d transport(const Motion& m) {
    const double rho = m.body.fluid_density;
    const Vector3d momentum = m.body.dynamic.transport * m.v;
    const double stalled = m.body.dynamic.spin_lift_onset * m.tip * m.tip;
    const double lost =
        m.body.dynamic.transport.trace() / 3.0 * stalled / std::max(m.v.squaredNorm() + stalled, 1e-300);
    return rho * motion_of(m.v.cross(momentum), m.omega.cross(momentum - lost * m.v));
}
inline Vector6d rotational_transport(const Motion& m) {
    const Vector3d momentum = m.body.added_coupling.transpose() * m.omega;
    const Vector3d angular = m.body.added_inertia * m.omega + m.body.added_coupling * m.v;
    return m.body.dynamic.rotational_transport *
           motion_of(m.v.cross(momentum) + m.omega.cross(angular), m.omega.cross(momentum));
}
inline Vector6d drag_in_motion(const Motion& m) {
    const double tip = m.tip * m.tip;
    const double share = tip / (motion_onset * m.v.squaredNorm() + tip);
    return motion_of(Vector3d::Zero(),
                     -0.5 * m.body.fluid_density * m.combined * share * m.body.dynamic.drag_in_motion * m.v);
}
inline Vector6d drag_in_spin(const Motion& m) {
    return motion_of(Vector3d::Zero(), -0.5 * m.body.fluid_density * m.tip * m.tip / m.combined *
                                           m.body.dynamic.drag_in_spin * m.v);
}
inline Vector6d rotational_drag_in_spin(const Motion& m) {
    return motion_of(-0.5 * m.body.fluid_density * m.tip * m.tip / m.combined *
                         m.body.dynamic.rotational_drag_in_spin * m.omega,
                     Vector3d::Zero());
}
inline Vector6d rotational_drag(const Motion& m) {
    const double reynolds = m.combined * m.body.length * m.body.fluid_density / m.body.viscosity;
    const double laminar = m.body.dynamic.laminar_rotational_drag * std::sqrt(1000.0 / reynolds);
    return motion_of(
        -0.5 * m.body.fluid_density * m.combined * (1.0 + laminar) * m.body.dynamic.rotational_drag * m.omega,
        Vector3d::Zero());
}
inline Vector6d creeping_turn(const Motion& m) {
    return motion_of(-std::numbers::pi * m.body.viscosity * std::pow(m.body.length, 3) * m.omega,
                     Vector3d::Zero());
}

/// Force and moment of a steady translation at a velocity, by the table.
inline std::pair<Vector3d, Vector3d> tabulated(const ImmersedBody& body, const Vector3d& velocity) {
    const double speed = velocity.norm();
    const LoadEntry entry = look_up(*body.tables, velocity / speed, reynolds_number(body, speed));
    const double pressure = 0.5 * body.fluid_density * speed * speed * body.reference_area;
    return {pressure * entry.force, pressure * body.length * entry.moment};
}

/// Of a steady translation, on one patch.
inline Vector3d patch_force(const ImmersedBody& body, const SteadyPatch& patch, const Vector3d& velocity) {
    if (patch.force.empty()) return patch.share * tabulated(body, velocity).first;
    ImmersedBody alone = body;
    for (std::size_t i = 0; i < patch.force.size(); ++i) alone.tables->entries[i].force = patch.force[i];
    return tabulated(alone, velocity).first;
}

/// The static table's part, less what transport leaves of the Kirchhoff moment.
inline Vector6d static_table(const Motion& m) {
    const auto& [force, steady_moment] = tabulated(m.body, m.v);
    const Vector3d left = m.body.added_mass * m.v - m.body.fluid_density * m.body.dynamic.transport * m.v;
    Vector3d moment = steady_moment - left.cross(m.v);
    for (const SteadyPatch& patch : m.body.patches)
        moment -= patch.place.cross(patch_force(m.body, patch, m.v));
    const double tip = m.tip * m.tip;
    const double share = m.v.squaredNorm() / (m.v.squaredNorm() + motion_onset * tip);
    const Vector3d arm = share * force.cross(moment) / force.squaredNorm();
    const Vector3d along = share * moment.dot(force) / force.squaredNorm() * force;
    Vector6d static_part = motion_of(along, -along.dot(m.omega) / m.v.squaredNorm() * m.v);
    for (const SteadyPatch& patch : m.body.patches) {
        const Vector3d place = arm + patch.place;
        const Vector3d local = patch_force(m.body, patch, m.v + m.omega.cross(place));
        static_part += motion_of(place.cross(local), local);
    }
    return static_part;
}
/// Stokes' resistance below the table.
inline Vector6d creeping_drag(const Motion& m) {
    const double lowest = m.body.tables->reynolds_numbers.front();
    const double share = std::max(0.0, 1.0 - reynolds_number(m.body, m.v.norm()) / lowest);
    return motion_of(Vector3d::Zero(),
                     -3.0 * std::numbers::pi * m.body.viscosity * m.body.length * share * m.v);
}

}  // namespace samara::test
