// The turbulence that a body sees, over one time step (docs/theory, "Langevin").
// Included once for each instruction set (Highway), hence no plain include guard.
#if defined(SAMARA_LANGEVIN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SAMARA_LANGEVIN_INL_H
#undef SAMARA_LANGEVIN_INL_H
#else
#define SAMARA_LANGEVIN_INL_H
#endif

#include "samara/core/kernel/random-inl.h"
#include "samara/core/kernel/step-inl.h"
#include "samara/core/kernel/wake_noise.hpp"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

/// k (m^2/s^2), epsilon (m^2/s^3).
template <class V>
struct Level {
    V turbulent_kinetic_energy, dissipation_rate;
};

template <class V>
HWY_INLINE Level<V> turbulence_level(const StepConstants& c, const Triple<V>& velocity) {
    if (c.turbulence != Turbulence::table) {
        return {V(c.turbulent_kinetic_energy), V(c.dissipation_rate)};
    }
    const Heading<V> heading = heading_of(velocity);
    Place<V> place;
    find_place(c.turbulence_by_direction, velocity, V(c.reynolds_factor) * heading.speed, place);
    Quad<V> row;
    look_up<1>(c.turbulence_by_direction, place, &row);
    const V square = (V(c.length) * heading.speed) * (V(c.length) * heading.speed);
    return {first_of(row) * square, second_of(row) * square * heading.speed};
}

/// epsilon / k, zero where there is no turbulence.
template <class V>
HWY_INLINE V turbulence_rate(const Level<V>& level) {
    const V least(1e-200);
    return select(least < level.turbulent_kinetic_energy,
                  level.dissipation_rate / larger(least, level.turbulent_kinetic_energy), V(0.0));
}

/// What a step keeps of a process that forgets at a rate, and the share of its stationary deviation that it
/// adds: exact whatever the step.
template <class V>
struct Renewal {
    V kept, added;
};
template <class V>
HWY_INLINE Renewal<V> renewal(V rate, V h) {
    const V zero(0.0);
    const V decay = -(rate * h);
    const V lost = exponential_less_one(decay);
    const auto alive = decay < zero;
    // Without a rate there is no turbulence: what was seen is gone.
    return {select(alive, V(1.0) + lost, zero),
            select(alive, root(larger(zero, -lost * (V(2.0) + lost))), zero)};
}

template <class V>
HWY_INLINE void advance_sampled_turbulence(const StepConstants& c, const Level<V>& level, V h,
                                           const SixNormals<V>& normals, Simulation<V>& simulation) {
    const Renewal<V> now = renewal(V(0.75 * kolmogorov_constant) * turbulence_rate(level), h);
    const V deviation = now.added * root(V(2.0 / 3.0) * level.turbulent_kinetic_energy);
    simulation.seen_velocity = now.kept * simulation.seen_velocity + deviation * normals.velocity;
    simulation.seen_rotation =
        now.kept * simulation.seen_rotation + (deviation * V(c.inverse_eddy_length)) * normals.rotation;
}

/// The slip of the wake, as lasting as the body takes to come so many of its lengths, and the weaker the more
/// the body turns on its way (docs/studies/noise).
template <class V>
HWY_INLINE void advance_wake(const StepConstants& c, const Level<V>& level, V h, const Triple<V>& normals,
                             Simulation<V>& simulation) {
    const Triple<V> velocity = centroid_velocity(c, simulation);
    const V lengths_per_second = V(c.length * c.inverse_eddy_length) * root(dot(velocity, velocity));
    const Renewal<V> now = renewal(V(1.0 / wake_persistence) * lengths_per_second, h);
    const V going = lengths_per_second * lengths_per_second;
    const V turning =
        V(wake_order * wake_order) * dot(simulation.angular_velocity, simulation.angular_velocity);
    const V least(1e-200);
    const V unordered = going / larger(least, going + turning);
    const V deviation = now.added * V(wake_fluctuation_share) * unordered *
                        root(V(2.0 / 3.0) * level.turbulent_kinetic_energy);
    simulation.seen_velocity = now.kept * simulation.seen_velocity + deviation * normals;
    simulation.seen_rotation = no_vector<V>();
}

template <class V>
HWY_INLINE void advance_body_velocity(const StepConstants& c, const Level<V>& level, V h,
                                      const SixNormals<V>& normals, Simulation<V>& simulation) {
    const V zero(0.0);
    const V rate = V(0.5 + 0.75 * kolmogorov_constant) * turbulence_rate(level);
    const V lost = exponential_less_one(-rate * h);
    const V diffusion = V(kolmogorov_constant) * level.dissipation_rate;
    const auto alive = zero < rate;
    const V variance = diffusion * (-lost * (V(2.0) + lost)) / (V(2.0) * select(alive, rate, V(1.0)));
    const V deviation = select(alive, root(larger(zero, variance)), zero);
    const V turning = select(alive, root(larger(zero, diffusion * h)) * V(c.inverse_eddy_length), zero);
    simulation.angular_velocity = simulation.angular_velocity + turning * normals.rotation;
    simulation.velocity = (V(1.0) + lost) * simulation.velocity + deviation * normals.velocity;
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
