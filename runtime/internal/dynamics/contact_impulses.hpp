#pragma once

#include <cstddef>

#include "internal/dynamics/immersed_body.hpp"

namespace samara {

/// A body over level ground: where its contact points stand and how fast they may come down.
struct Stance {
    Matrix3d to_world = Matrix3d::Identity();
    double height = 0.0;     ///< m: of the centre of mass above the ground
    double margin = 0.0;     ///< m: contact points that stand higher are left out
    double touching = 0.0;   ///< m: gaps up to this count as none
    double time_step = 0.0;  ///< s: in which a point may close what is left of its gap, and no more
    Vector6d drift = Vector6d::Zero();  ///< a velocity that it has besides, (omega, v) in body axes
};

/// What inelastic impulses with Coulomb friction and rolling resistance make of a velocity (omega, v; body
/// axes, relative to the ground). They act where a contact point would else go through the ground, found one
/// after the other, on `most_contacts` points at most, and never add energy: w K w / 2 does not grow. Never
/// throws or allocates.
///
/// Projected Gauss-Seidel on the impulses: Erleben, Velocity-based shock propagation for multibody dynamics
/// animation, ACM Transactions on Graphics 26(2), 2007, section 3; the inertia here is K, the fluid's
/// included.
Vector6d after_impulses(const ImmersedBody& body, const Stance& stance, const Vector6d& velocity) noexcept;
inline constexpr std::size_t most_contacts = 16;

}  // namespace samara
