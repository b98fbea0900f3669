// The turbulence that a body samples, over one time step (docs/explanation/noise-and-wake.md), and its random
// numbers: Philox4x32-10 (noise.hpp) and Box and Muller's transform. Included once for each instruction set
// (Highway), hence no plain include guard.
#if defined(SAMARA_LANGEVIN_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SAMARA_LANGEVIN_INL_H
#undef SAMARA_LANGEVIN_INL_H
#else
#define SAMARA_LANGEVIN_INL_H
#endif

#include <array>

#include "samara/core/kernel/step-inl.h"
#include "samara/core/kernel/step_constants.hpp"
#include "samara/core/kernel/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

/// Normal numbers for the fluid's velocity and its rotation.
template <class V>
struct SixNormals {
    Triple<V> velocity, rotation;
};

/// Makes two independent normal numbers of two that are uniform in (0, 1).
template <class V>
HWY_INLINE void normal_pair(V first, V second, V& a, V& b) {
    const V radius = root(larger(V(0.0), V(-2.0) * logarithm(first)));
    V cosine;
    V sine;
    cosine_and_sine_of_revolution(second, cosine, sine);
    a = radius * cosine;
    b = radius * sine;
}

/// Returns normal numbers of two draws: the four of the first make the velocity's and the first of the
/// rotation's, two of the second the rest.
template <class V>
HWY_INLINE SixNormals<V> six_normals(const std::array<V, 4>& first, V fifth, V sixth) {
    SixNormals<V> n;
    normal_pair(first[0], first[1], n.velocity.x, n.velocity.y);
    normal_pair(first[2], first[3], n.velocity.z, n.rotation.x);
    normal_pair(fifth, sixth, n.rotation.y, n.rotation.z);
    return n;
}
/// Returns the velocity's numbers of six_normals() alone.
template <class V>
HWY_INLINE Triple<V> three_normals(const std::array<V, 4>& first) {
    Triple<V> n;
    V of_rotation;
    normal_pair(first[0], first[1], n.x, n.y);
    normal_pair(first[2], first[3], n.z, of_rotation);
    return n;
}

/// Computes the high and low halves of a product with a constant.
template <class Words, class W = hn::Vec<Words>>
HWY_INLINE void wide_product(Words words, W a, std::uint32_t factor, W& high, W& low) {
#if HWY_TARGET == HWY_SCALAR
    const std::uint64_t product = std::uint64_t{hn::GetLane(a)} * factor;
    high = hn::Set(words, static_cast<std::uint32_t>(product >> 32U));
    low = hn::Set(words, static_cast<std::uint32_t>(product));
#else
    const hn::Repartition<std::uint64_t, Words> wide;
    const auto multiplier = hn::Set(words, factor);
    const auto even = hn::MulEven(a, multiplier);
    const auto odd = hn::MulEven(hn::BitCast(words, hn::ShiftRight<32>(hn::BitCast(wide, a))), multiplier);
    low = hn::OddEven(hn::BitCast(words, hn::ShiftLeft<32>(odd)), hn::BitCast(words, even));
    high = hn::OddEven(hn::BitCast(words, odd), hn::BitCast(words, hn::ShiftRight<32>(even)));
#endif
}

/// Returns Philox4x32-10 of counters and keys: Salmon, Moraes, Dror, Shaw, SC11; Random123's philox.h holds
/// the constants.
template <class Words, class W = hn::Vec<Words>>
HWY_INLINE std::array<W, 4> philox(Words words, std::array<W, 4> counter, W key0, W key1) {
    for (int round = 0; round < 10; ++round) {
        W high0;
        W low0;
        W high1;
        W low1;
        wide_product(words, counter[0], 0xD2511F53U, high0, low0);
        wide_product(words, counter[2], 0xCD9E8D57U, high1, low1);
        counter = {hn::Xor(hn::Xor(high1, counter[1]), key0), low1, hn::Xor(hn::Xor(high0, counter[3]), key1),
                   low0};
        key0 = hn::Add(key0, hn::Set(words, 0x9E3779B9U));
        key1 = hn::Add(key1, hn::Set(words, 0xBB67AE85U));
    }
    return counter;
}

/// Returns (bits + 1/2) / 2^32.
template <class Tag>
HWY_INLINE Lanes<Tag> unit_interval(Tag tag, hn::Vec<hn::Rebind<std::uint32_t, Tag>> bits) {
    const hn::Rebind<std::uint32_t, Tag> words;
    const hn::Rebind<std::int32_t, Tag> integers;
    if constexpr (in_single_precision<Lanes<Tag>>) {
        // Of the first 24 bits: the largest number rounds to one.
        const Lanes<Tag> number = hn::ConvertTo(tag, hn::BitCast(integers, hn::ShiftRight<8>(bits)));
        return (number + Lanes<Tag>(0.5)) * Lanes<Tag>(0x1p-24);
    } else {
        // Only signed numbers convert on all machines: the sign's bit is moved into the sum.
        const auto centered = hn::BitCast(integers, hn::Xor(bits, hn::Set(words, 0x80000000U)));
        const Lanes<Tag> number = hn::PromoteTo(tag, centered);
        return (number + Lanes<Tag>(0x1p31 + 0.5)) * Lanes<Tag>(0x1p-32);
    }
}

/// The turbulence around a body: k (m^2/s^2), epsilon (m^2/s^3).
template <class V>
struct Level {
    V turbulent_kinetic_energy, dissipation_rate;
};

template <class V>
HWY_INLINE Level<V> turbulence_level(const ConstantsOf<V>& c, const Triple<V>& velocity) {
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

/// Returns epsilon / k, zero where there is no turbulence.
template <class V>
HWY_INLINE V turbulence_rate(const Level<V>& level) {
    return select(V(least<V>) < level.turbulent_kinetic_energy,
                  level.dissipation_rate / larger(V(least<V>), level.turbulent_kinetic_energy), V(0.0));
}

/// The share that a step keeps of an Ornstein-Uhlenbeck process of a given rate, and the share of its
/// stationary deviation that it adds: exact whatever the step.
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
    // Without a rate there is no turbulence: the sampled one vanishes.
    return {select(alive, V(1.0) + lost, zero),
            select(alive, root(larger(zero, -lost * (V(2.0) + lost))), zero)};
}

template <class V>
HWY_INLINE void advance_sampled_turbulence(const ConstantsOf<V>& c, const Level<V>& level, V h,
                                           const SixNormals<V>& normals, StepState<V>& step_state) {
    const Renewal<V> now = renewal(V(0.75 * kolmogorov_constant) * turbulence_rate(level), h);
    const V deviation = now.added * root(V(2.0 / 3.0) * level.turbulent_kinetic_energy);
    step_state.sampled_velocity = now.kept * step_state.sampled_velocity + deviation * normals.velocity;
    step_state.sampled_rotation =
        now.kept * step_state.sampled_rotation + (deviation * V(c.inverse_eddy_length)) * normals.rotation;
}

/// Updates the velocity fluctuation by the wake, whose rms is smaller the more the body rotates on its path
/// (docs/studies/noise).
template <class V>
HWY_INLINE void advance_wake(const ConstantsOf<V>& c, const Level<V>& level, V h, const Triple<V>& normals,
                             StepState<V>& step_state) {
    const Triple<V> velocity = centroid_velocity(c, step_state);
    const V lengths_per_second = V(c.length * c.inverse_eddy_length) * root(dot(velocity, velocity));
    const V rate = c.wake_noise.rate_by_dissipation > 0.0
                       ? V(c.wake_noise.rate_by_dissipation) * turbulence_rate(level)
                       : V(c.wake_noise.rate_by_way) * lengths_per_second;
    const Renewal<V> now = renewal(rate, h);
    const V going = lengths_per_second * lengths_per_second;
    const V rotation_rate =
        V(wake_order * wake_order) * dot(step_state.angular_velocity, step_state.angular_velocity);
    const V unordered = going / larger(V(least<V>), going + rotation_rate);
    const V deviation =
        now.added * V(c.wake_noise.share) * unordered * root(V(2.0 / 3.0) * level.turbulent_kinetic_energy);
    step_state.sampled_velocity = now.kept * step_state.sampled_velocity + deviation * normals;
    step_state.sampled_rotation = no_vector<V>();
}

template <class V>
HWY_INLINE void advance_body_velocity(const ConstantsOf<V>& c, const Level<V>& level, V h,
                                      const SixNormals<V>& normals, StepState<V>& step_state) {
    const V zero(0.0);
    const V rate = V(0.5 + 0.75 * kolmogorov_constant) * turbulence_rate(level);
    const V lost = exponential_less_one(-rate * h);
    const V diffusion = V(kolmogorov_constant) * level.dissipation_rate;
    const auto alive = zero < rate;
    const V variance = diffusion * (-lost * (V(2.0) + lost)) / (V(2.0) * select(alive, rate, V(1.0)));
    const V deviation = select(alive, root(larger(zero, variance)), zero);
    const V rotation_rate = select(alive, root(larger(zero, diffusion * h)) * V(c.inverse_eddy_length), zero);
    step_state.angular_velocity = step_state.angular_velocity + rotation_rate * normals.rotation;
    step_state.velocity = (V(1.0) + lost) * step_state.velocity + deviation * normals.velocity;
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
