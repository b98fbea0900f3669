// Random numbers of a copy of a body at a step: Philox4x32-10 (noise.hpp) and Box and Muller's transform.
// Included once for each instruction set (Highway), hence no plain include guard.
#if defined(SAMARA_RANDOM_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SAMARA_RANDOM_INL_H
#undef SAMARA_RANDOM_INL_H
#else
#define SAMARA_RANDOM_INL_H
#endif

#include <array>

#include "samara/core/kernel/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

/// Of the fluid's velocity and of its rotation.
template <class V>
struct SixNormals {
    Triple<V> velocity, rotation;
};

/// Two independent normal numbers of two that are uniform in (0, 1).
template <class V>
HWY_INLINE void normal_pair(V first, V second, V& a, V& b) {
    const V radius = root(larger(V(0.0), V(-2.0) * logarithm(first)));
    V cosine;
    V sine;
    cosine_and_sine_of_turn(second, cosine, sine);
    a = radius * cosine;
    b = radius * sine;
}

/// Four numbers of one draw make the velocity's and the first of the rotation's, two of another the rest.
template <class V>
HWY_INLINE SixNormals<V> six_normals(const std::array<V, 4>& first, V fifth, V sixth) {
    SixNormals<V> n;
    normal_pair(first[0], first[1], n.velocity.x, n.velocity.y);
    normal_pair(first[2], first[3], n.velocity.z, n.rotation.x);
    normal_pair(fifth, sixth, n.rotation.y, n.rotation.z);
    return n;
}
/// The velocity's alone, the same.
template <class V>
HWY_INLINE Triple<V> three_normals(const std::array<V, 4>& first) {
    Triple<V> n;
    V of_rotation;
    normal_pair(first[0], first[1], n.x, n.y);
    normal_pair(first[2], first[3], n.z, of_rotation);
    return n;
}

/// The high and low halves of a product with a constant.
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

/// Philox4x32-10 of counters and keys: Salmon, Moraes, Dror, Shaw, SC11; Random123's philox.h holds the
/// constants.
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

/// (bits + 1/2) / 2^32.
template <class Tag>
HWY_INLINE Lanes<Tag> unit_interval(Tag tag, hn::Vec<hn::Rebind<std::uint32_t, Tag>> bits) {
    const hn::Rebind<std::uint32_t, Tag> words;
    const hn::Rebind<std::int32_t, Tag> integers;
    // Signed numbers alone convert on all machines: the sign's bit is moved into the sum.
    const auto centered = hn::BitCast(integers, hn::Xor(bits, hn::Set(words, 0x80000000U)));
    const Lanes<Tag> number = hn::PromoteTo(tag, centered);
    return (number + Lanes<Tag>(0x1p31 + 0.5)) * Lanes<Tag>(0x1p-32);
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
