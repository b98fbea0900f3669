// The wake behind a body (docs/theory, "A wake that forms").
// Included once for each instruction set (Highway), hence no plain include guard.
#if defined(SAMARA_WAKE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SAMARA_WAKE_INL_H
#undef SAMARA_WAKE_INL_H
#else
#define SAMARA_WAKE_INL_H
#endif

#include "samara/core/kernel/loads-inl.h"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

/// Wake of body_state.hpp.
template <class V>
struct WakeState {
    V formed;
    Triple<V> heading;
};

template <class Condition, class V>
HWY_INLINE WakeState<V> select(Condition condition, const WakeState<V>& a, const WakeState<V>& b) {
    return {select(condition, a.formed, b.formed), select(condition, a.heading, b.heading)};
}

/// shares_of() of loads.hpp.
template <class V>
HWY_INLINE Shares<V> shares_of(const WakeState<V>& wake) {
    const V square = dot(wake.heading, wake.heading);
    const V fourth = square * square;
    return {wake.formed, fourth * fourth};
}

/// The wake when the body has moved at these velocities over a time: its share tends to one and its heading
/// to the direction of the velocity, what differs going as exp(-x), x the way over that in which a wake forms
/// or a heading settles, here to the second order and never below zero.
template <class V>
HWY_INLINE WakeState<V> wake_after(const StepConstants& c, const WakeState<V>& wake, V time,
                                   const Triple<V>& omega, const Triple<V>& velocity,
                                   const Triple<V>& direction) {
    const auto kept_after = [](V x) HWY_ATTR { return V(1.0) / (V(1.0) + x * (V(1.0) + V(0.5) * x)); };
    const V speed_square = dot(velocity, velocity);
    const V reach_square = dot(velocity, broadcast_symmetric<V>(c.squared_formation_length) * velocity);
    const V x =
        time * combined_speed(c, omega, velocity) * root(speed_square / larger(V(tiny), reach_square));
    return {V(1.0) + kept_after(x) * (wake.formed - V(1.0)),
            direction + kept_after(V(c.settling_over_formation) * x) * (wake.heading - direction)};
}

/// The wake in the middle of a step over h that begins with `wake` and moves at these velocities.
template <class V>
HWY_INLINE WakeState<V> wake_in_the_middle(const StepConstants& c, WakeState<V> wake, V h,
                                           const Triple<V>& omega, const Triple<V>& velocity,
                                           const Triple<V>& half_turn) {
    if (c.has_spin_about_symmetry) {
        wake.heading = turned_back(broadcast_symmetric<V>(c.spin_about_symmetry) * half_turn, wake.heading);
    }
    return wake_after(c, wake, V(0.5) * h, omega, velocity, heading_of(velocity).direction);
}

/// And in its end.
template <class V>
HWY_INLINE WakeState<V> wake_in_the_end(const StepConstants& c, WakeState<V> wake, V h,
                                        const Triple<V>& omega, const Triple<V>& velocity,
                                        const Triple<V>& half_turn) {
    Triple<V> direction = heading_of(velocity).direction;
    if (c.has_spin_about_symmetry) {
        const Triple<V> unseen = broadcast_symmetric<V>(c.spin_about_symmetry) * half_turn;
        wake.heading = turned_back(unseen, wake.heading - cross(unseen, wake.heading));
        direction = turned_back(unseen, direction);
    }
    return wake_after(c, wake, h, omega, velocity, direction);
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
