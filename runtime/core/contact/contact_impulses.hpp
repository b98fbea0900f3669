#pragma once

#include <cstddef>
#include <optional>

#include "samara/core/collision/contact_set.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/physics/contact_record.hpp"

namespace samara {

/// How a body comes to what it may touch.
struct Approach {
    double margin = 0.0;     ///< m: points with a larger gap are left out
    double touching = 0.0;   ///< m: gaps up to this count as none
    double time_step = 0.0;  ///< s: in which a point may close what is left of its gap, and no more
    /// A velocity that it has besides, (omega, v) in body axes, relative to the ground. Where there is one,
    /// obstacles that move do so under it, and what impulses change is a way over which they stand still.
    std::optional<Vector6d> drift = {};
};

/// What inelastic impulses with Coulomb friction and rolling resistance make of a velocity (omega, v; body
/// axes, relative to the ground). They act where a near point would else go through what it may meet, found
/// one after the other, on `most_contacts` points at most, and never add energy but the work of obstacles
/// that move: else w K w / 2 does not grow. `met` (null: not asked for) becomes what they are, in body axes
/// and from the centre of mass, without a time. Never throws or allocates.
///
/// Projected Gauss-Seidel on the impulses: Erleben, Velocity-based shock propagation for multibody dynamics
/// animation, ACM Transactions on Graphics 26(2), 2007, section 3; the inertia here is K, the fluid's
/// included.
Vector6d after_impulses(const TouchingBody& body, const ContactSet& near, const Approach& approach,
                        const Vector6d& velocity, ContactRecord* met = nullptr) noexcept;

/// How far the load of a contact point stands off it, over the bounding radius: what stops a ball that rolls
/// and a body that rocks or spins. Chosen, not measured: 0.1 mm for a body of 2 cm (docs/theory.md#ground).
inline constexpr double rolling_resistance = 0.005;
inline constexpr std::size_t most_contacts = 16;

}  // namespace samara
