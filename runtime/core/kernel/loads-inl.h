// The fluid's loads beyond the Kirchhoff terms, as a matrix (docs/explanation/moving-loads.md#the-terms).
// Included once for each instruction set (Highway), hence no plain include guard.
#if defined(SAMARA_LOADS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SAMARA_LOADS_INL_H
#undef SAMARA_LOADS_INL_H
#else
#define SAMARA_LOADS_INL_H
#endif

#include "samara/core/body/dynamic_coefficients.hpp"
#include "samara/core/kernel/tables-inl.h"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

/// The blocks of D: the moment and force are -D (omega, v).
template <class V>
struct LoadBlocks {
    Square<V> moment_by_rotation, moment_by_velocity, force_by_rotation, force_by_velocity;
};

/// A velocity's length and direction (shorter than one where it has none).
template <class V>
struct Heading {
    V speed;
    Triple<V> direction;
};
template <class V>
HWY_INLINE Heading<V> heading_of(const Triple<V>& velocity) {
    const V speed = root(dot(velocity, velocity));
    return {speed, (V(1.0) / larger(V(tiny<V>), speed)) * velocity};
}

/// Eq. 5 in its regular form: the load on a body of that area in a steady translation, in units of the
/// dynamic pressure.
template <class V>
HWY_INLINE Triple<V> coefficient_force(const ConstantsOf<V>& c, const Triple<V>& direction, V area) {
    const Triple<V> normal = broadcast<V>(c.normal);
    const V along = dot(direction, normal);
    const Triple<V> lift = (V(c.twice_lift_coefficient) * along) * (normal - along * direction);
    return -area * (V(c.drag_coefficient) * direction + lift);
}

/// WakeShares of loads.hpp.
template <class V>
struct Shares {
    V transport, moment;
};

/// The force of a steady translation in units of rho A U^2 / 2, and its moment in units of rho A L U^2 / 2
/// about the centroid.
template <class V>
struct SteadyCoefficients {
    Triple<V> force, moment;
};

template <bool with_moment, class V>
HWY_INLINE SteadyCoefficients<V> steady_coefficients(const ConstantsOf<V>& c,
                                                     const DirectionTable<RealOf<V>>& by_direction,
                                                     const Triple<V>& velocity, const Heading<V>& heading) {
    Place<V> place;
    find_place(by_direction, velocity, V(c.reynolds_factor) * heading.speed, place);
    Quad<V> numbers[2];
    look_up<with_moment ? 2 : 1>(by_direction, place, numbers);
    const Triple<V> force = first_three(numbers[0]);
    if (c.loads == Loads::coefficients) {
        const Triple<V> of_area = coefficient_force(c, heading.direction, first_of(numbers[0]));
        return {of_area, cross(broadcast<V>(c.center_of_pressure), of_area)};
    }
    if constexpr (with_moment) return {force, first_three(numbers[1])};
    return {force, no_vector<V>()};
}

/// The point where the steady force acts, and the part of its moment that no arm can give (in units of the
/// speed squared).
template <class V>
struct PressurePoint {
    Triple<V> arm, moment_along_force;
};
template <class V>
HWY_INLINE PressurePoint<V> pressure_point(const ConstantsOf<V>& c, const Triple<V>& velocity,
                                           const Heading<V>& heading, V share) {
    const SteadyCoefficients<V> steady =
        steady_coefficients<true>(c, c.loads_by_direction, velocity, heading);
    // The Kirchhoff moment of a steady translation on the equations' left side that transport does not
    // cancel.
    const Triple<V> kirchhoff =
        cross(broadcast_symmetric<V>(c.potential_transport) * heading.direction, heading.direction);
    const Triple<V> moment = steady.moment - kirchhoff;
    const V square = dot(steady.force, steady.force);
    const V scale = share / larger(V(tiny<V>), square);
    return {scale * cross(steady.force, moment),
            (V(c.steady_factor) * scale * dot(moment, steady.force)) * steady.force};
}

/// A patch's force at its point as -(drag + side x): the lift rotates with the flow and does no work.
template <class V>
struct SteadyMatrix {
    V drag;
    Triple<V> side;
};
template <class V>
HWY_INLINE SteadyMatrix<V> steady_matrix(const ConstantsOf<V>& c, const LoadPatch<RealOf<V>>& patch,
                                         const Triple<V>& velocity) {
    const Heading<V> heading = heading_of(velocity);
    const bool own = !patch.force.rows.empty();
    const Triple<V> force =
        steady_coefficients<false>(c, own ? patch.force : c.loads_by_direction, velocity, heading).force;
    const V scale = V(own ? c.steady_factor : patch.share * c.steady_factor) * heading.speed;
    return {scale * larger(V(0.0), -dot(force, heading.direction)), scale * cross(force, heading.direction)};
}

/// Returns the load blocks of the steady matrix about the centroid, for a force that acts at the arm r.
template <class V>
HWY_INLINE LoadBlocks<V> moved_by_arm(const SteadyMatrix<V>& steady, const Triple<V>& r) {
    const V along = dot(r, steady.side);
    const Triple<V> drag_arm = steady.drag * r;
    return {plus_cross(plus_diagonal(-outer(drag_arm, r), dot(drag_arm, r)), along * r),
            plus_cross(plus_diagonal(outer(steady.side, r), -along), drag_arm),
            plus_cross(plus_diagonal(-outer(r, steady.side), along), -drag_arm),
            scaling_and_cross(steady.drag, steady.side)};
}

/// Returns the steady matrix about the centroid, of a force that acts at the arm r: on each patch of the
/// surface its part depends on its own velocity and place. A steady translation is that of the whole body; no
/// patch adds energy.
template <class V>
HWY_INLINE LoadBlocks<V> steady_blocks(const ConstantsOf<V>& c, const Triple<V>& omega,
                                       const Triple<V>& velocity, const Triple<V>& r) {
    const auto of_patch = [&](const LoadPatch<RealOf<V>>& patch) HWY_ATTR {
        const Triple<V> arm = r + broadcast<V>(patch.place);
        return moved_by_arm(steady_matrix(c, patch, velocity + cross(omega, arm)), arm);
    };
    LoadBlocks<V> blocks = of_patch(c.patches[0]);
    for (std::size_t i = 1; i < c.patches.size(); ++i) {
        const LoadBlocks<V> more = of_patch(c.patches[i]);
        blocks.moment_by_rotation = blocks.moment_by_rotation + more.moment_by_rotation;
        blocks.moment_by_velocity = blocks.moment_by_velocity + more.moment_by_velocity;
        blocks.force_by_rotation = blocks.force_by_rotation + more.force_by_rotation;
        blocks.force_by_velocity = blocks.force_by_velocity + more.force_by_velocity;
    }
    return blocks;
}

/// Adds the part of the steady moment that no arm gives. Its work on a rotating body comes from the
/// translation, as wind drives a mill: in all it does no work.
template <class V>
HWY_INLINE void add_windmill(const Triple<V>& moment_along_force, const Triple<V>& velocity,
                             LoadBlocks<V>& blocks) {
    blocks.moment_by_velocity = blocks.moment_by_velocity - outer(moment_along_force, velocity);
    blocks.force_by_rotation = blocks.force_by_rotation + outer(velocity, moment_along_force);
}

/// Returns a / (a + b), and 0 where both are zero.
template <class V>
HWY_INLINE V share_of(V a, V b) {
    return a / larger(V(tiny<V>), a + b);
}

/// Adds force omega x p and moment v x p + omega x l of the momenta (l, p) that separated flow lacks: it does
/// no work. It acts on the rotation of the body's axes themselves, since these momenta belong to the
/// equations' left side. `omega`: the body's own. `share`: of the wake that has formed; without a wake the
/// moment is the potential flow's.
template <class V>
HWY_INLINE void add_transport(const ConstantsOf<V>& c, const Triple<V>& omega, const Triple<V>& velocity,
                              V share, LoadBlocks<V>& blocks) {
    // The isotropic part of T acts as a force alone, and as the steady force from the first: its moment v x v
    // is zero, and must stay so where D acts on another v than the one it was made with.
    V spin_lift(c.isotropic_transport);
    if (c.spin_lift_onset > 0.0) {
        const V speed_square = dot(velocity, velocity);
        const V tip_square = V(c.half_length * c.half_length) * dot(omega, omega);
        spin_lift = spin_lift * share_of(speed_square, V(c.spin_lift_onset) * tip_square);
    }
    blocks.force_by_velocity = plus_cross(blocks.force_by_velocity, -spin_lift * omega);
    Triple<V> momentum = broadcast_symmetric<V>(c.directed_transport) * velocity;
    if (c.transports_rotation) {
        const Square<V> coupling = broadcast<V>(c.coupling_transport);
        momentum = momentum + transposed_times(coupling, omega);
        const Triple<V> angular_momentum =
            broadcast_symmetric<V>(c.transport_of_rotation) * omega + coupling * velocity;
        blocks.moment_by_rotation = plus_cross(blocks.moment_by_rotation, share * angular_momentum);
    }
    momentum = share * momentum;
    blocks.moment_by_velocity = plus_cross(blocks.moment_by_velocity, momentum);
    blocks.force_by_rotation = plus_cross(blocks.force_by_rotation, momentum);
}

/// Adds the force across the path by which a fluctuating wake acts on the body's sides: it does no work.
/// `wake_fluctuation`: by the wake (l/s, body axes).
template <class V>
HWY_INLINE void add_side_pressure(const ConstantsOf<V>& c, const Triple<V>& velocity,
                                  const Triple<V>& wake_fluctuation, LoadBlocks<V>& blocks) {
    const Triple<V> pressed = broadcast_symmetric<V>(c.side_pressure) * wake_fluctuation;
    blocks.force_by_velocity =
        plus_cross(blocks.force_by_velocity, cross(pressed, heading_of(velocity).direction));
}

/// Returns the combined speed of translation and rotation, in l a second.
template <class V>
HWY_INLINE V combined_speed(const ConstantsOf<V>& c, const Triple<V>& omega, const Triple<V>& velocity) {
    return root(dot(velocity, velocity) + V(c.half_length * c.half_length) * dot(omega, omega));
}

/// Adds the part of the rotational drag about the direction of motion that falls lack
/// (docs/explanation/moving-loads.md).
template <class V>
HWY_INLINE void add_roll_drag(const ConstantsOf<V>& c, const Heading<V>& heading, LoadBlocks<V>& blocks) {
    const Triple<V>& direction = heading.direction;
    const V lacking = dot(direction, broadcast_symmetric<V>(c.lacking_roll_drag) * direction);
    blocks.moment_by_rotation =
        blocks.moment_by_rotation + outer((heading.speed * lacking) * direction, direction);
}

/// Returns the part of D that acts on the motion relative to the fluid. `omega` and `velocity`: the body's
/// angular velocity and that of its centroid, relative to the fluid. `rotation`: the angular velocity itself,
/// by which the flow departs from that of a steady translation; the effect of turbulence is in the table
/// already. `share`: of the steady moment that is there, without which its force has no arm.
template <class V>
HWY_INLINE LoadBlocks<V> relative_load_blocks(const ConstantsOf<V>& c, const Triple<V>& omega,
                                              const Triple<V>& velocity, const Triple<V>& rotation, V share) {
    const Heading<V> heading = heading_of(velocity);
    const V speed_square = dot(velocity, velocity);
    const V reach_square(c.half_length * c.half_length);
    const V tip_square = reach_square * dot(rotation, rotation);
    const V combined = combined_speed(c, omega, velocity);

    // The steady moment stays until the body does little but rotate: a steady translation keeps it whole.
    const V motion = share_of(tip_square, V(motion_onset) * speed_square);
    const PressurePoint<V> point =
        pressure_point(c, velocity, heading, share * share_of(speed_square, V(motion_onset) * tip_square));
    LoadBlocks<V> blocks = steady_blocks(c, omega, velocity, point.arm);
    add_windmill(point.moment_along_force, velocity, blocks);

    const V in_motion = combined * motion;
    const V creeping_drag =
        V(c.creeping_drag) *
        larger(V(0.0), V(1.0) - V(c.reynolds_factor) * heading.speed * V(c.creeping_fades));
    V rotating = combined;
    if (c.laminar_rotation > 0.0) rotating = rotating + V(c.laminar_rotation) * root(combined);
    blocks.moment_by_rotation =
        plus_diagonal(blocks.moment_by_rotation + rotating * broadcast_symmetric<V>(c.rotational_drag),
                      V(c.creeping_rotation));
    blocks.force_by_velocity = plus_diagonal(
        blocks.force_by_velocity + in_motion * broadcast_symmetric<V>(c.drag_in_motion), creeping_drag);
    if (c.has_roll_drag) add_roll_drag(c, heading, blocks);
    if (c.has_spin) {
        const V in_spin = combined * share_of(tip_square, speed_square);
        blocks.moment_by_rotation =
            blocks.moment_by_rotation + in_spin * broadcast_symmetric<V>(c.rotational_drag_in_spin);
        blocks.force_by_velocity =
            blocks.force_by_velocity + in_spin * broadcast_symmetric<V>(c.drag_in_spin);
    }
    return blocks;
}

/// Wake of body_state.hpp in the step's numbers.
template <class V>
struct WakeState {
    V formed;
    Triple<V> heading;
};

template <class Condition, class V>
HWY_INLINE WakeState<V> select(Condition condition, const WakeState<V>& a, const WakeState<V>& b) {
    return {select(condition, a.formed, b.formed), select(condition, a.heading, b.heading)};
}

/// Returns shares_of() of loads.hpp.
template <class V>
HWY_INLINE Shares<V> shares_of(const WakeState<V>& wake) {
    const V square = dot(wake.heading, wake.heading);
    const V fourth = square * square;
    return {wake.formed, fourth * fourth};
}

/// Returns the wake after the body has moved at these velocities for a time: its share tends to one and its
/// heading to the direction of the velocity. The differences decay as exp(-x), with x the distance over that
/// in which a wake forms or a heading settles, here to the second order and never below zero.
template <class V>
HWY_INLINE WakeState<V> wake_after(const ConstantsOf<V>& c, const WakeState<V>& wake, V time,
                                   const Triple<V>& omega, const Triple<V>& velocity,
                                   const Triple<V>& direction) {
    const auto kept_after = [](V x) HWY_ATTR { return V(1.0) / (V(1.0) + x * (V(1.0) + V(0.5) * x)); };
    const V speed_square = dot(velocity, velocity);
    const V reach_square = dot(velocity, broadcast_symmetric<V>(c.squared_formation_length) * velocity);
    const V x =
        time * combined_speed(c, omega, velocity) * root(speed_square / larger(V(tiny<V>), reach_square));
    return {V(1.0) + kept_after(x) * (wake.formed - V(1.0)),
            direction + kept_after(V(c.settling_over_formation) * x) * (wake.heading - direction)};
}

/// Returns the wake in the middle of a step over h that begins with `wake` and moves at these velocities.
template <class V>
HWY_INLINE WakeState<V> wake_in_the_middle(const ConstantsOf<V>& c, WakeState<V> wake, V h,
                                           const Triple<V>& omega, const Triple<V>& velocity,
                                           const Triple<V>& half_rotation) {
    if (c.has_spin_about_symmetry) {
        wake.heading =
            rotated_back(broadcast_symmetric<V>(c.spin_about_symmetry) * half_rotation, wake.heading);
    }
    return wake_after(c, wake, V(0.5) * h, omega, velocity, heading_of(velocity).direction);
}

/// Returns the wake at the end of the step.
template <class V>
HWY_INLINE WakeState<V> wake_in_the_end(const ConstantsOf<V>& c, WakeState<V> wake, V h,
                                        const Triple<V>& omega, const Triple<V>& velocity,
                                        const Triple<V>& half_rotation) {
    Triple<V> direction = heading_of(velocity).direction;
    if (c.has_spin_about_symmetry) {
        const Triple<V> spin = broadcast_symmetric<V>(c.spin_about_symmetry) * half_rotation;
        wake.heading = rotated_back(spin, wake.heading - cross(spin, wake.heading));
        direction = rotated_back(spin, direction);
    }
    return wake_after(c, wake, h, omega, velocity, direction);
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
