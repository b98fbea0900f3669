#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "samara/core/collision/contact_set.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/physics/contact_record.hpp"

namespace samara {

inline constexpr std::size_t most_contacts = 16;  ///< of a body, at which impulses act

/// The approach of a body to what it may touch.
struct Approach {
    double margin = 0.0;     ///< m: points with a larger gap are ignored
    double touching = 0.0;   ///< m: gaps up to this count as none
    double time_step = 0.0;  ///< s: the time in which a point may close the rest of its gap, and no more
    /// An additional velocity (omega, v) in body axes, relative to the ground. Where there is one, moving
    /// obstacles move under it, and impulses change a displacement over which they stand still.
    std::optional<Vector6d> drift = {};
};

/// An impulse (N s) and a moment of one (N m s) at a near point of a body.
struct FoundImpulse {
    Vector3d point;  ///< the near point's
    int obstacle;    ///< the near point's
    Vector6d size;   ///< along two tangents and the normal, and about them
};

/// The impulses that were found for a body: a good guess for those of the same points a moment later.
struct FoundImpulses {
    std::array<FoundImpulse, most_contacts> all;
    std::size_t count = 0;

    /// Multiplies all impulses.
    void scale(double factor) noexcept {
        for (std::size_t i = 0; i < count; ++i) all[i].size *= factor;
    }
    void add(const FoundImpulse& one) noexcept { all[count++] = one; }
    [[nodiscard]] const FoundImpulse* begin() const noexcept { return all.data(); }
    [[nodiscard]] const FoundImpulse* end() const noexcept { return all.data() + count; }
};

/// Returns a velocity (omega, v; body axes, relative to the ground) after inelastic impulses with Coulomb
/// friction and rolling resistance. They act where a near point would otherwise penetrate, found one after
/// the other, at `most_contacts` points at most, and never add energy but the work of moving obstacles: w K w
/// / 2 does not grow otherwise. `found` (null: none) has a guess, from which the search begins, and receives
/// the impulses. `record` (null: not asked for) receives them in body axes and from the centre of mass,
/// without a time. Never throws or allocates.
///
/// Projected Gauss-Seidel on the impulses: Erleben, Velocity-based shock propagation for multibody dynamics
/// animation, ACM Transactions on Graphics 26(2), 2007, section 3; the inertia here is K, the fluid's
/// included. As one body has six velocities only, all sticking points are solved for together after each
/// sweep, and sliding ones are extrapolated from two.
Vector6d after_impulses(const TouchingBody& body, const ContactSet& near, const Approach& approach,
                        const Vector6d& velocity, FoundImpulses* found = nullptr,
                        ContactRecord* record = nullptr) noexcept;

}  // namespace samara
