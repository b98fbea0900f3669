// One body's numbers in vectors of their own: the three components that are lanes of three vectors for many
// bodies are three lanes of one here. The same operations in the same order, so to the same bits. Included
// once for each instruction set (Highway), hence no plain include guard.
#if defined(SAMARA_PACKED_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SAMARA_PACKED_INL_H
#undef SAMARA_PACKED_INL_H
#else
#define SAMARA_PACKED_INL_H
#endif

#include "samara/core/kernel/numbers-inl.h"
#include "samara/core/kernel/triple.hpp"

#undef SAMARA_PACKS_ONE_BODY
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
#define SAMARA_PACKS_ONE_BODY 1
#else
#define SAMARA_PACKS_ONE_BODY 0
#endif

HWY_BEFORE_NAMESPACE();
namespace samara {

#if SAMARA_PACKS_ONE_BODY
namespace HWY_NAMESPACE {

using FourTag = hn::FixedTag<double, 4>;
using FourLanes = hn::Vec<FourTag>;
/// A number of one body, in each of four lanes.
using Spread = Lanes<FourTag, true>;

/// Returns the lanes that the two bits each of `order` name, the first lane's lowest.
template <int order>
HWY_INLINE FourLanes permuted(FourLanes a) {
    return FourLanes{_mm256_permute4x64_pd(a.raw, order)};
}
/// Returns the lanes of b whose bits are set, and the others of a.
template <int of_b>
HWY_INLINE FourLanes blended(FourLanes a, FourLanes b) {
    return FourLanes{_mm256_blend_pd(a.raw, b.raw, of_b)};
}

}  // namespace HWY_NAMESPACE

/// Three numbers in a vector; its fourth lane has no meaning.
template <>
struct Triple<HWY_NAMESPACE::Spread> {
    HWY_NAMESPACE::FourLanes raw;

    Triple() = default;
    HWY_INLINE Triple(HWY_NAMESPACE::FourLanes lanes) : raw(lanes) {}
    HWY_INLINE Triple(HWY_NAMESPACE::Spread x, HWY_NAMESPACE::Spread y, HWY_NAMESPACE::Spread z)
        : raw(HWY_NAMESPACE::blended<0b1100>(HWY_NAMESPACE::blended<0b0010>(x.raw, y.raw), z.raw)) {}
};

namespace HWY_NAMESPACE {

using Packed = Triple<Spread>;
/// A matrix by its columns, unlike those of other numbers: a product with a vector is then a sum of multiples
/// of them.
using PackedSquare = Square<Spread>;

HWY_INLINE Spread x_of(const Packed& a) {
    return permuted<0x00>(a.raw);
}
HWY_INLINE Spread y_of(const Packed& a) {
    return permuted<0x55>(a.raw);
}
HWY_INLINE Spread z_of(const Packed& a) {
    return permuted<0xAA>(a.raw);
}

HWY_INLINE Packed operator+(const Packed& a, const Packed& b) {
    return hn::Add(a.raw, b.raw);
}
HWY_INLINE Packed operator-(const Packed& a, const Packed& b) {
    return hn::Sub(a.raw, b.raw);
}
HWY_INLINE Packed operator-(const Packed& a) {
    return hn::Neg(a.raw);
}
HWY_INLINE Packed operator*(Spread s, const Packed& a) {
    return hn::Mul(s.raw, a.raw);
}
HWY_INLINE Packed product_of_each(const Packed& a, const Packed& b) {
    return hn::Mul(a.raw, b.raw);
}
HWY_INLINE Spread sum_of(const Packed& a) {
    return x_of(a) + y_of(a) + z_of(a);
}
HWY_INLINE Spread largest_of(const Packed& a) {
    return larger(larger(x_of(a), y_of(a)), z_of(a));
}
HWY_INLINE Spread dot(const Packed& a, const Packed& b) {
    return sum_of(product_of_each(a, b));
}
HWY_INLINE Packed cross(const Packed& a, const Packed& b) {
    constexpr int next = 0b11'00'10'01;  // y, z, x
    const FourLanes before =
        hn::Sub(hn::Mul(a.raw, permuted<next>(b.raw)), hn::Mul(permuted<next>(a.raw), b.raw));
    return permuted<next>(before);
}
HWY_INLINE Packed select(hn::Mask<FourTag> condition, const Packed& a, const Packed& b) {
    return hn::IfThenElse(condition, a.raw, b.raw);
}

HWY_INLINE PackedSquare operator*(Spread s, const PackedSquare& a) {
    return {s * a.x, s * a.y, s * a.z};
}
HWY_INLINE Packed operator*(const PackedSquare& a, const Packed& b) {
    return x_of(b) * a.x + y_of(b) * a.y + z_of(b) * a.z;
}
HWY_INLINE PackedSquare operator*(const PackedSquare& a, const PackedSquare& b) {
    return {a * b.x, a * b.y, a * b.z};
}
HWY_INLINE PackedSquare transposed(const PackedSquare& a) {
    const __m256d xy_low = _mm256_unpacklo_pd(a.x.raw.raw, a.y.raw.raw);   // xx, yx, xz, yz
    const __m256d xy_high = _mm256_unpackhi_pd(a.x.raw.raw, a.y.raw.raw);  // xy, yy
    const __m256d z_high = _mm256_unpackhi_pd(a.z.raw.raw, a.z.raw.raw);   // zy, zy
    return {Packed(FourLanes{_mm256_permute2f128_pd(xy_low, a.z.raw.raw, 0x20)}),
            Packed(FourLanes{_mm256_permute2f128_pd(xy_high, z_high, 0x20)}),
            Packed(FourLanes{_mm256_permute2f128_pd(xy_low, a.z.raw.raw, 0x31)})};
}
HWY_INLINE Packed transposed_times(const PackedSquare& a, const Packed& b) {
    return transposed(a) * b;
}
HWY_INLINE PackedSquare outer(const Packed& a, const Packed& b) {
    return {x_of(b) * a, y_of(b) * a, z_of(b) * a};
}
HWY_INLINE Packed diagonal_of(const PackedSquare& a) {
    return blended<0b0100>(blended<0b0010>(a.x.raw, a.y.raw), a.z.raw);
}
HWY_INLINE PackedSquare plus_diagonal(const PackedSquare& a, Spread s) {
    return {Packed(blended<0b0001>(a.x.raw, hn::Add(a.x.raw, s.raw))),
            Packed(blended<0b0010>(a.y.raw, hn::Add(a.y.raw, s.raw))),
            Packed(blended<0b0100>(a.z.raw, hn::Add(a.z.raw, s.raw)))};
}
/// Returns the columns of w^ but for their diagonal, which is -0: it adds nothing, not even a sign.
HWY_INLINE PackedSquare cross_of(const Packed& w) {
    const auto signed_by = [](FourLanes a, double x, double y, double z) HWY_ATTR {
        return Packed(hn::Xor(a, FourLanes{_mm256_setr_pd(x, y, z, 0.0)}));
    };
    const FourLanes none = hn::Zero(FourTag());
    return {signed_by(blended<0b0001>(permuted<0b00'01'10'00>(w.raw), none), -0.0, 0.0, -0.0),
            signed_by(blended<0b0010>(permuted<0b00'00'00'10>(w.raw), none), -0.0, -0.0, 0.0),
            signed_by(blended<0b0100>(permuted<0b00'00'00'01>(w.raw), none), 0.0, -0.0, -0.0)};
}
HWY_INLINE PackedSquare scaling_and_cross(Spread s, const Packed& w) {
    const PackedSquare cross = cross_of(w);
    return {Packed(blended<0b0001>(cross.x.raw, s.raw)), Packed(blended<0b0010>(cross.y.raw, s.raw)),
            Packed(blended<0b0100>(cross.z.raw, s.raw))};
}
HWY_INLINE PackedSquare plus_cross(const PackedSquare& a, const Packed& w) {
    const PackedSquare cross = cross_of(w);
    return {a.x + cross.x, a.y + cross.y, a.z + cross.z};
}
/// Columns of the adjugate are the crosses of a's rows.
HWY_INLINE PackedSquare inverse(const PackedSquare& a) {
    const PackedSquare rows = transposed(a);
    const Packed first = cross(rows.y, rows.z);
    const Spread scale = Spread(1.0) / dot(rows.x, first);
    return {scale * first, scale * cross(rows.z, rows.x), scale * cross(rows.x, rows.y)};
}

/// Returns the rotation matrix of the quaternion (w, v).
HWY_INLINE PackedSquare rotation_matrix(Spread w, const Packed& v) {
    constexpr int next = 0b11'00'10'01;          // y, z, x
    constexpr int next_but_one = 0b11'01'00'10;  // z, x, y
    const Packed twice = Spread(2.0) * v;
    const Packed squares = product_of_each(v, twice);
    const FourLanes others = hn::Add(permuted<next>(squares.raw), permuted<next_but_one>(squares.raw));
    const FourLanes diagonal = hn::Sub(Spread(1.0).raw, others);
    const PackedSquare all = plus_cross(outer(v, twice), w * twice);
    return {Packed(blended<0b0001>(all.x.raw, diagonal)), Packed(blended<0b0010>(all.y.raw, diagonal)),
            Packed(blended<0b0100>(all.z.raw, diagonal))};
}

/// Loads a triple from memory, with its zero.
HWY_INLINE Packed packed(const Triple<double>& a) {
    return hn::Load(FourTag(), reinterpret_cast<const double*>(&a));
}

}  // namespace HWY_NAMESPACE
#endif

}  // namespace samara
HWY_AFTER_NAMESPACE();

#endif
