// The wind's formulas (docs/explanation/noise-and-wake.md#wind).
// Included once for each instruction set (Highway), hence no plain include guard.
#if defined(SAMARA_WIND_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SAMARA_WIND_INL_H
#undef SAMARA_WIND_INL_H
#else
#define SAMARA_WIND_INL_H
#endif

#include "samara/core/kernel/vectors-inl.h"
#include "samara/core/kernel/wind_constants.hpp"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

/// The wind at one place: u (m/s), du_i/dx_j (1/s, by rows) and du/dt (m/s^2).
template <class V>
struct WindThere {
    Triple<V> velocity;
    Square<V> gradient;
    Triple<V> rate;
};

template <class V>
HWY_INLINE void add(const Triple<V>& velocity, const Square<V>& gradient, WindThere<V>& there) {
    there.velocity = there.velocity + velocity;
    there.gradient = there.gradient + gradient;
}

/// Computes (1 - exp(-q))/q for q >= 0, its derivative, and exp(-q).
template <class V>
struct Bell {
    V mean, slope, power;
};
template <class V>
HWY_INLINE Bell<V> bell(V q) {
    // Near the axis the closed forms are differences of nearly equal numbers.
    constexpr double means[] = {1.0, -1.0 / 2, 1.0 / 6, -1.0 / 24, 1.0 / 120, -1.0 / 720};
    constexpr double slopes[] = {-1.0 / 2, 1.0 / 3, -1.0 / 8, 1.0 / 30, -1.0 / 144, 1.0 / 840};
    constexpr double near = 0.02;
    const V lost = exponential_less_one(-q);
    const V held = larger(q, V(near));
    const V inverse = V(1.0) / held;
    const V mean = -lost * inverse;
    const V power = V(1.0) + lost;
    return {select(q < V(near), polynomial(means, q), mean),
            select(q < V(near), polynomial(slopes, q), (power - mean) * inverse), power};
}

template <class V>
HWY_INLINE void add_profile(const WindConstants& wind, const Triple<V>& place, WindThere<V>& there) {
    const V zero(0.0);
    const V height = place.z - V(wind.ground);
    V share;
    V slope;
    if (wind.profile == WindConstants::Profile::logarithmic) {
        const V ratio = V(1.0) + larger(zero, height) * V(wind.inverse_scale);
        share = V(wind.exponent) * logarithm(ratio);
        slope = V(wind.exponent * wind.inverse_scale) / ratio;
    } else {
        const V held = larger(height, V(wind.lowest));
        const V power = V(wind.exponent) * logarithm(held * V(wind.inverse_scale));
        const V small = V(1.0) + exponential_less_one(-magnitude(power));
        const V whole = select(power < zero, small, V(1.0) / small);
        const auto straight = height < V(wind.lowest);
        share = select(straight, whole * height / V(wind.lowest), whole);
        slope = select(straight, whole / V(wind.lowest), V(wind.exponent) * whole / held);
    }
    const auto below = height < zero;
    share = select(below, zero, share);
    slope = select(below, zero, slope);
    const Triple<V> velocity = broadcast<V>(wind.profile_velocity);
    add(share * velocity, outer(slope * velocity, {zero, zero, V(1.0)}), there);
}

template <class V>
HWY_INLINE void add_gusts(const WindConstants& wind, const Triple<V>& place, V time, WindThere<V>& there) {
    constexpr double revolution = 6.28318530717958647693;
    const Triple<V> drift = broadcast<V>(wind.drift);
    const Triple<V> carried = place - time * drift;
    const Triple<V> none = broadcast<V>(Triple<double>{0.0, 0.0, 0.0});
    WindThere<V> gusts{none, {none, none, none}, none};
    for (const GustWave& wave : wind.waves) {
        const Triple<V> number = broadcast<V>(wave.wave_number);
        const V revolutions = dot(number, carried) + V(wave.phase);
        V cosine;
        V sine;
        cosine_and_sine_of_revolution(revolutions - whole_part(revolutions), cosine, sine);
        const Triple<V> a = broadcast<V>(wave.a);
        const Triple<V> b = broadcast<V>(wave.b);
        add(cosine * a + sine * b, outer(cosine * b - sine * a, V(revolution) * number), gusts);
    }
    add(gusts.velocity, gusts.gradient, there);
    there.rate = there.rate - gusts.gradient * drift;
}

template <class V>
HWY_INLINE void add_vortex(const VortexConstants& vortex, const Triple<V>& place, V time,
                           WindThere<V>& there) {
    const V zero(0.0);
    const Triple<V> axis = broadcast<V>(vortex.axis);
    const Triple<V> moved = broadcast<V>(vortex.velocity);
    const Triple<V> offset = place - broadcast<V>(vortex.position) - time * moved;
    const Triple<V> from_axis = offset - dot(axis, offset) * axis;
    const V square = dot(from_axis, from_axis);
    const V inverse(vortex.inverse_square);
    V rate;   // of rotation
    V slope;  // its derivative by the square
    if (vortex.rankine) {
        const auto inside = square < V(vortex.core_square);
        rate = V(vortex.strength) / larger(square, V(vortex.core_square));
        slope = select(inside, zero, -rate / larger(square, V(vortex.core_square)));
    } else {
        const Bell<V> core = bell(square * inverse);
        rate = V(vortex.strength) * inverse * core.mean;
        slope = V(vortex.strength) * inverse * inverse * core.slope;
    }
    const Triple<V> around = cross(axis, from_axis);
    const Square<V> gradient = plus_cross(outer(V(2.0) * slope * around, from_axis), rate * axis);
    add(rate * around, gradient, there);
    there.rate = there.rate - gradient * moved;
}

template <class V>
HWY_INLINE void add_fan(const FanConstants& fan, const Triple<V>& place, WindThere<V>& there) {
    const V zero(0.0);
    constexpr double widening = 0.107;
    const Triple<V> ahead = broadcast<V>(fan.direction);
    const Triple<V> offset = place - broadcast<V>(fan.position);
    const V s = dot(ahead, offset);
    const Triple<V> aside = offset - s * ahead;
    // The bell's width and its derivatives.
    const V far = root(s * s + V(fan.width * fan.width));
    const V width = V(fan.width) + V(0.5 * widening) * (s + far);
    const V width1 = V(0.5 * widening) * (V(1.0) + s / far);
    const V width2 = V(0.5 * widening * fan.width * fan.width) / (far * far * far);
    // The share of the air that is drawn in up to there.
    const V t = larger(zero, smaller(V(1.0), V(1.0) + s / V(fan.intake)));
    const V left = V(1.0) - t;
    const V share = t * t * t * (V(10.0) + t * (V(6.0) * t - V(15.0)));
    const V share1 = V(30.0 / fan.intake) * (t * t) * (left * left);
    const V share2 = V(60.0 / (fan.intake * fan.intake)) * t * left * (left - t);
    // The stream function is flow (1 - exp(-q)), q = r^2/width^2.
    const V flow = V(fan.half_flow) * width * share;
    const V flow1 = V(fan.half_flow) * (width1 * share + width * share1);
    const V flow2 = V(fan.half_flow) * (width2 * share + V(2.0) * width1 * share1 + width * share2);
    const V inverse = V(1.0) / width;
    const V inverse2 = inverse * inverse;
    const V narrowing = width1 * inverse;
    const V q = dot(aside, aside) * inverse2;
    const Bell<V> b = bell(q);
    const V forward = V(2.0) * flow * inverse2 * b.power;
    const V forward_s = V(2.0) * inverse2 * (flow1 - V(2.0) * flow * narrowing) * b.power;
    // The velocity across the axis is `outward` times the distance from it.
    const V drawn = flow1 * inverse2;
    const V drawn1 = (flow2 - V(2.0) * flow1 * narrowing) * inverse2;
    const V spread = V(2.0) * flow * narrowing * inverse2;
    const V spread1 = V(2.0) * inverse2 *
                      (flow1 * narrowing + flow * width2 * inverse - V(3.0) * flow * narrowing * narrowing);
    const V outward = spread * b.power - drawn * b.mean;
    const V outward_s = spread1 * b.power - drawn1 * b.mean;
    const V outward_q = -spread * b.power - drawn * b.slope;
    const V q_s = V(-2.0) * q * narrowing;
    const Triple<V> q_aside = (V(2.0) * inverse2) * aside;
    const Triple<V> of_forward = (forward_s - forward * q_s) * ahead - forward * q_aside;
    const Triple<V> of_outward = (outward_s + outward_q * q_s) * ahead + outward_q * q_aside;
    const Square<V> gradient =
        plus_diagonal(outer(ahead, of_forward - outward * ahead) + outer(aside, of_outward), outward);
    add(forward * ahead + outward * aside, gradient, there);
}

/// Returns the sum of a wind's parts at one place and time.
template <class V>
HWY_INLINE WindThere<V> wind_at(const WindConstants& wind, const Triple<V>& place, V time) {
    const V zero(0.0);
    const Triple<V> none{zero, zero, zero};
    WindThere<V> there{none, {none, none, none}, none};
    if (wind.profile != WindConstants::Profile::none) add_profile(wind, place, there);
    if (!wind.waves.empty()) add_gusts(wind, place, time, there);
    for (const VortexConstants& vortex : wind.vortices) add_vortex(vortex, place, time, there);
    for (const FanConstants& fan : wind.fans) add_fan(fan, place, there);
    return there;
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
