// The number types of the step's formulas: double, or Lanes of a Highway vector, with the same operations.
// Included once for each instruction set (Highway), hence no plain include guard.
#if defined(SAMARA_NUMBERS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SAMARA_NUMBERS_INL_H
#undef SAMARA_NUMBERS_INL_H
#else
#define SAMARA_NUMBERS_INL_H
#endif

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

inline constexpr bool max_is_of_x86 =
    HWY_TARGET == HWY_SSE4 || HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3;

/// A vector of numbers: one for each of several bodies, or equal ones of one body (packed-inl.h).
template <class Tag, bool of_one_body = false>
struct Lanes {
    hn::Vec<Tag> raw;

    Lanes() = default;
    HWY_INLINE Lanes(hn::Vec<Tag> value) : raw(value) {}
    HWY_INLINE Lanes(double value) : raw(hn::Set(Tag(), static_cast<hn::TFromD<Tag>>(value))) {}

    friend HWY_INLINE Lanes operator+(Lanes a, Lanes b) { return hn::Add(a.raw, b.raw); }
    friend HWY_INLINE Lanes operator-(Lanes a, Lanes b) { return hn::Sub(a.raw, b.raw); }
    friend HWY_INLINE Lanes operator*(Lanes a, Lanes b) { return hn::Mul(a.raw, b.raw); }
    friend HWY_INLINE Lanes operator/(Lanes a, Lanes b) { return hn::Div(a.raw, b.raw); }
    friend HWY_INLINE Lanes operator-(Lanes a) { return hn::Neg(a.raw); }
    friend HWY_INLINE hn::Mask<Tag> operator<(Lanes a, Lanes b) { return hn::Lt(a.raw, b.raw); }
    friend HWY_INLINE Lanes root(Lanes a) { return hn::Sqrt(a.raw); }
    friend HWY_INLINE Lanes magnitude(Lanes a) { return hn::Abs(a.raw); }
    friend HWY_INLINE Lanes whole_part(Lanes a) { return hn::Floor(a.raw); }
    // Returns the first of NaN and a number, where x86's own maximum returns the second.
    friend HWY_INLINE Lanes larger(Lanes a, Lanes b) {
        if constexpr (max_is_of_x86) return hn::Max(b.raw, a.raw);
        return select(a < b, b, a);
    }
    friend HWY_INLINE Lanes smaller(Lanes a, Lanes b) {
        if constexpr (max_is_of_x86) return hn::Min(b.raw, a.raw);
        return select(b < a, b, a);
    }
    friend HWY_INLINE Lanes select(hn::Mask<Tag> condition, Lanes a, Lanes b) {
        return hn::IfThenElse(condition, a.raw, b.raw);
    }
};

#if HWY_TARGET == HWY_SCALAR
// One lane is both halves of its vector.
template <class Tag>
using HalfOf = Tag;
template <class Tag, class Vector = hn::Vec<Tag>>
HWY_INLINE Vector lower_half(Tag /*half*/, Vector whole) {
    return whole;
}
template <class Tag, class Vector = hn::Vec<Tag>>
HWY_INLINE Vector upper_half(Tag /*half*/, Vector whole) {
    return whole;
}
template <class Tag, class Vector = hn::Vec<Tag>>
HWY_INLINE Vector joined(Tag /*whole*/, Vector /*upper*/, Vector lower) {
    return lower;
}
#else
template <class Tag>
using HalfOf = hn::Half<Tag>;
template <class Half, class Vector>
HWY_INLINE hn::Vec<Half> lower_half(Half half, Vector whole) {
    return hn::LowerHalf(half, whole);
}
template <class Half, class Vector>
HWY_INLINE hn::Vec<Half> upper_half(Half half, Vector whole) {
    return hn::UpperHalf(half, whole);
}
template <class Tag, class Vector>
HWY_INLINE hn::Vec<Tag> joined(Tag tag, Vector upper, Vector lower) {
    return hn::Combine(tag, upper, lower);
}
#endif

/// Lanes of double precision beside those of Tag, which are of single.
template <class Tag>
struct Wide {
    using Half = HalfOf<Tag>;
    using Doubles = hn::Rebind<double, Half>;
    using Part = Lanes<Doubles>;
    Part low, high;

    Wide() = default;
    HWY_INLINE Wide(Part first, Part second) : low(first), high(second) {}
    HWY_INLINE Wide(double value) : low(value), high(value) {}
    HWY_INLINE Wide(Lanes<Tag> a)
        : low(hn::PromoteTo(Doubles(), lower_half(Half(), a.raw))),
          high(hn::PromoteTo(Doubles(), upper_half(Half(), a.raw))) {}

    friend HWY_INLINE Wide operator+(Wide a, Wide b) { return {a.low + b.low, a.high + b.high}; }
    friend HWY_INLINE Wide operator-(Wide a, Wide b) { return {a.low - b.low, a.high - b.high}; }
    friend HWY_INLINE Wide operator*(Wide a, Wide b) { return {a.low * b.low, a.high * b.high}; }
    friend HWY_INLINE Wide larger(Wide a, Wide b) { return {larger(a.low, b.low), larger(a.high, b.high)}; }
    friend HWY_INLINE Wide smaller(Wide a, Wide b) {
        return {smaller(a.low, b.low), smaller(a.high, b.high)};
    }
    friend HWY_INLINE Wide select(hn::Mask<Tag> condition, Wide a, Wide b) {
        const Wide chosen(Lanes<Tag>(hn::IfThenElseZero(condition, hn::Set(Tag(), 1.0F))));
        const Part half(0.5);
        return {select(half < chosen.low, a.low, b.low), select(half < chosen.high, a.high, b.high)};
    }
    friend HWY_INLINE Lanes<Tag> rounded(Wide a) {
        return joined(Tag(), hn::DemoteTo(Half(), a.high.raw), hn::DemoteTo(Half(), a.low.raw));
    }
};
/// Returns a place's number in the precision of the step.
template <class Tag>
HWY_INLINE Lanes<Tag> rounded(Lanes<Tag> a) {
    return a;
}

HWY_INLINE double root(double a) {
    return std::sqrt(a);
}
HWY_INLINE double magnitude(double a) {
    return std::abs(a);
}
HWY_INLINE double whole_part(double a) {
    return std::floor(a);
}
HWY_INLINE double larger(double a, double b) {
    return a < b ? b : a;
}
HWY_INLINE double smaller(double a, double b) {
    return b < a ? b : a;
}
HWY_INLINE double select(bool condition, double a, double b) {
    return condition ? a : b;
}

/// Returns whether one of two conditions holds.
HWY_INLINE bool either(bool a, bool b) {
    return a || b;
}
template <class Mask>
HWY_INLINE Mask either(Mask a, Mask b) {
    return hn::Or(a, b);
}

template <class V>
struct NumberTraits;
template <>
struct NumberTraits<double> {
    using Real = double;
    using Position = double;
    using Mask = bool;
    static HWY_INLINE bool any_of(bool condition) { return condition; }
    static HWY_INLINE double power_of_two(double n) {
        return std::bit_cast<double>((static_cast<std::int64_t>(n) + 1023) << 52);
    }
    /// x = mantissa 2^exponent with the mantissa in [1, 2); x > 0 and normal.
    static HWY_INLINE double exponent(double x) {
        return static_cast<double>((std::bit_cast<std::int64_t>(x) >> 52) - 1023);
    }
    static HWY_INLINE double mantissa(double x) {
        constexpr std::int64_t bits = (std::int64_t{1} << 52) - 1;
        return std::bit_cast<double>((std::bit_cast<std::int64_t>(x) & bits) | (std::int64_t{1023} << 52));
    }
};
template <class Tag, bool of_one_body>
struct NumberTraits<Lanes<Tag, of_one_body>> {
    using Number = Lanes<Tag, of_one_body>;
    using Real = hn::TFromD<Tag>;
    using Position = std::conditional_t<std::is_same_v<Real, double>, Number, Wide<Tag>>;
    using Mask = hn::Mask<Tag>;
    using Integers = hn::RebindToSigned<Tag>;
    static constexpr int fraction_bits = std::numeric_limits<Real>::digits - 1;
    static constexpr int bias = std::numeric_limits<Real>::max_exponent - 1;

    static HWY_INLINE bool any_of(Mask condition) { return !hn::AllFalse(Tag(), condition); }
    static HWY_INLINE Number power_of_two(Number n) {
        const Integers integers;
        // The sum's last bits are n: its exponent field keeps them in place.
        const auto whole = to_integers(n);
        return hn::BitCast(Tag(), hn::ShiftLeft<fraction_bits>(hn::Add(whole, hn::Set(integers, bias))));
    }
    static HWY_INLINE Number exponent(Number x) {
        const Integers integers;
        const auto field = hn::ShiftRight<fraction_bits>(hn::BitCast(integers, x.raw));
        return to_numbers(hn::Sub(field, hn::Set(integers, bias)));
    }
    static HWY_INLINE Number mantissa(Number x) {
        const Integers integers;
        constexpr auto bits =
            static_cast<hn::TFromD<Integers>>((static_cast<hn::TFromD<Integers>>(1) << fraction_bits) - 1);
        const auto fraction = hn::And(hn::BitCast(integers, x.raw), hn::Set(integers, bits));
        return hn::Or(hn::BitCast(Tag(), fraction), hn::Set(Tag(), Real{1}));
    }

  private:
    // Integers of small size by way of a large number's last bits: exact, and on every instruction set.
    static constexpr double large = 1.5 * static_cast<double>(std::int64_t{1} << fraction_bits);
    static HWY_INLINE hn::Vec<Integers> to_integers(Number n) {
        const Integers integers;
        const auto base = hn::BitCast(integers, Number(large).raw);
        return hn::Sub(hn::BitCast(integers, (n + Number(large)).raw), base);
    }
    static HWY_INLINE Number to_numbers(hn::Vec<Integers> n) {
        const Integers integers;
        const auto base = hn::BitCast(integers, Number(large).raw);
        return Number(hn::BitCast(Tag(), hn::Add(n, base))) - Number(large);
    }
};

template <class V>
using RealOf = typename NumberTraits<V>::Real;
/// The numbers of a body's position: of double precision.
template <class V>
using PositionOf = typename NumberTraits<V>::Position;
template <class V>
inline constexpr bool in_single_precision = std::is_same_v<RealOf<V>, float>;

/// A speed (1/s, lengths in body lengths) below which a direction has no meaning; its square is a normal
/// number.
template <class V>
inline constexpr double tiny = in_single_precision<V> ? 1e-15 : 1e-140;
/// The least divisor of a rate or an energy.
template <class V>
inline constexpr double least = in_single_precision<V> ? 1e-30 : 1e-200;

/// Loads a row of numbers in double precision.
template <class Tag>
HWY_INLINE PositionOf<Lanes<Tag>> load_row(Tag tag, const double* row) {
    if constexpr (std::is_same_v<hn::TFromD<Tag>, double>) {
        return Lanes<Tag>(hn::LoadU(tag, row));
    } else {
        const typename Wide<Tag>::Doubles part;
        return {hn::LoadU(part, row), hn::LoadU(part, row + hn::Lanes(tag) - hn::Lanes(part))};
    }
}
template <class Tag>
HWY_INLINE void store_row(Lanes<Tag> numbers, double* row) {
    hn::StoreU(numbers.raw, Tag(), row);
}
template <class Tag>
HWY_INLINE void store_row(Wide<Tag> numbers, double* row) {
    store_row(numbers.low, row);
    store_row(numbers.high, row + hn::Lanes(Tag()) - hn::Lanes(HalfOf<Tag>()));
}

/// Returns c[first] + c[first + stride] x + ... in pairs (Estrin's scheme): a short chain, where Horner's
/// rule is a long one.
template <int first, int stride, int N, class V>
HWY_INLINE V polynomial_from(const double (&c)[N], V x) {
    if constexpr (first + stride >= N) {
        return V(c[first]);
    } else {
        const V square = x * x;
        return polynomial_from<first, 2 * stride>(c, square) +
               x * polynomial_from<first + stride, 2 * stride>(c, square);
    }
}
/// Returns c[0] + c[1] x + ...
template <int N, class V>
HWY_INLINE V polynomial(const double (&c)[N], V x) {
    return polynomial_from<0, 1>(c, x);
}

/// Returns polynomial() of all coefficients, or in single precision of the first `single`.
template <int single, int N, class V>
HWY_INLINE V short_polynomial(const double (&c)[N], V x) {
    if constexpr (!in_single_precision<V>) return polynomial(c, x);
    double first[single];
    for (int i = 0; i < single; ++i) first[i] = c[i];
    return polynomial(first, x);
}

/// Returns the natural logarithm of a positive normal number: twice the series of artanh of s, |s| < 0.172,
/// with the coefficients `c`, of which single precision needs four.
template <int N, class V>
HWY_INLINE V logarithm_by(const double (&c)[N], V x) {
    using Traits = NumberTraits<V>;
    constexpr double ln2 = 0.693147180559945309417;
    const V m = Traits::mantissa(x);
    const auto above = V(1.41421356237309504880) < m;
    const V mantissa = select(above, m * V(0.5), m);
    const V exponent = Traits::exponent(x) + select(above, V(1.0), V(0.0));
    const V s = (mantissa - V(1.0)) / (mantissa + V(1.0));
    return exponent * V(ln2) + s * short_polynomial<4>(c, s * s);
}
/// Returns the logarithm to its last bits.
template <class V>
HWY_INLINE V logarithm(V x) {
    return logarithm_by(
        {2.0, 2.0 / 3, 2.0 / 5, 2.0 / 7, 2.0 / 9, 2.0 / 11, 2.0 / 13, 2.0 / 15, 2.0 / 17, 2.0 / 19, 2.0 / 21},
        x);
}
/// Returns the logarithm to 1e-14, in a shorter chain.
template <class V>
HWY_INLINE V short_logarithm(V x) {
    return logarithm_by({2.0, 2.0 / 3, 2.0 / 5, 2.0 / 7, 2.0 / 9, 2.0 / 11, 2.0 / 13, 2.0 / 15}, x);
}

/// Returns exp(x) - 1 for x <= 0, accurate near zero: Taylor's series about the nearest multiple of ln 2.
template <class V>
HWY_INLINE V exponential_less_one(V x) {
    constexpr bool single = in_single_precision<V>;
    constexpr double lowest = single ? -80.0 : -700.0;
    constexpr double ln2_high = single ? 0.693359375 : 0x1.62e42fee00000p-1;
    constexpr double ln2_low = single ? -2.12194440054690583e-4 : 1.90821492927058770002e-10;
    const V held = larger(x, V(lowest));
    const V n = whole_part(held * V(1.44269504088896340736) + V(0.5));
    const V y = held - n * V(ln2_high) - n * V(ln2_low);
    constexpr double c[] = {1.0,
                            1.0 / 2,
                            1.0 / 6,
                            1.0 / 24,
                            1.0 / 120,
                            1.0 / 720,
                            1.0 / 5040,
                            1.0 / 40320,
                            1.0 / 362880,
                            1.0 / 3628800,
                            1.0 / 39916800,
                            1.0 / 479001600,
                            1.0 / 6227020800};
    const V series = y * short_polynomial<7>(c, y);
    const V power = NumberTraits<V>::power_of_two(n);
    return power * series + (power - V(1.0));
}

/// Computes cosine and sine of a fraction u in [0, 1) of a revolution: of the angle 2 pi u.
template <class V>
HWY_INLINE void cosine_and_sine_of_revolution(V u, V& cosine, V& sine) {
    const V quarters = u * V(4.0);
    const V n = whole_part(quarters + V(0.5));
    const V angle = (quarters - n) * V(1.57079632679489661923);
    const V square = angle * angle;
    constexpr double sines[] = {1.0,
                                -1.0 / 6,
                                1.0 / 120,
                                -1.0 / 5040,
                                1.0 / 362880,
                                -1.0 / 39916800,
                                1.0 / 6227020800,
                                -1.0 / 1307674368000,
                                1.0 / 355687428096000};
    constexpr double cosines[] = {1.0,
                                  -1.0 / 2,
                                  1.0 / 24,
                                  -1.0 / 720,
                                  1.0 / 40320,
                                  -1.0 / 3628800,
                                  1.0 / 479001600,
                                  -1.0 / 87178291200,
                                  1.0 / 20922789888000};
    const V s = angle * short_polynomial<5>(sines, square);
    const V c = short_polynomial<5>(cosines, square);
    // n = 0 .. 4 quarters lie below the angle.
    const V odd = n - V(2.0) * whole_part(n * V(0.5));
    const auto swapped = V(0.5) < odd;
    const V first = select(swapped, s, c);
    const V second = select(swapped, c, s);
    const auto cosine_negative = magnitude(n - V(1.5)) < V(1.0);
    const auto sine_negative = magnitude(n - V(2.5)) < V(1.0);
    cosine = select(cosine_negative, -first, first);
    sine = select(sine_negative, -second, second);
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
