// Vectors and 3x3 matrices of the step's numbers.
// Included once for each instruction set (Highway), hence no plain include guard.
#if defined(SAMARA_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SAMARA_VECTORS_INL_H
#undef SAMARA_VECTORS_INL_H
#else
#define SAMARA_VECTORS_INL_H
#endif

#include <type_traits>

#include "samara/core/kernel/packed-inl.h"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

#if SAMARA_PACKS_ONE_BODY
template <class V>
inline constexpr bool is_packed = std::is_same_v<V, Spread>;
#else
template <class V>
inline constexpr bool is_packed = false;
#endif

/// Returns vectors of equal lanes.
template <class V, class Number>
HWY_INLINE Triple<V> broadcast(const Triple<Number>& a) {
    if constexpr (is_packed<V>) {
        return packed(a);
    } else {
        return {V(a.x), V(a.y), V(a.z)};
    }
}
/// Returns equal lanes of a symmetric matrix, whose rows are its columns.
template <class V, class Number>
HWY_INLINE Square<V> broadcast_symmetric(const Square<Number>& a) {
    return {broadcast<V>(a.x), broadcast<V>(a.y), broadcast<V>(a.z)};
}
template <class V, class Number>
HWY_INLINE Square<V> broadcast(const Square<Number>& a) {
    if constexpr (is_packed<V>) {
        return transposed(broadcast_symmetric<V>(a));
    } else {
        return broadcast_symmetric<V>(a);
    }
}
template <class V>
HWY_INLINE Triple<V> no_vector() {
    return {V(0.0), V(0.0), V(0.0)};
}
template <class V>
HWY_INLINE Square<V> no_matrix() {
    return {no_vector<V>(), no_vector<V>(), no_vector<V>()};
}

template <class V>
HWY_INLINE Triple<V> operator+(const Triple<V>& a, const Triple<V>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
HWY_INLINE Triple<V> operator-(const Triple<V>& a, const Triple<V>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V>
HWY_INLINE Triple<V> operator-(const Triple<V>& a) {
    return {-a.x, -a.y, -a.z};
}
template <class V>
HWY_INLINE Triple<V> operator*(V s, const Triple<V>& a) {
    return {s * a.x, s * a.y, s * a.z};
}
template <class V>
HWY_INLINE Triple<V> product_of_each(const Triple<V>& a, const Triple<V>& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class V>
HWY_INLINE V largest_of(const Triple<V>& a) {
    return larger(larger(a.x, a.y), a.z);
}
template <class V>
HWY_INLINE V dot(const Triple<V>& a, const Triple<V>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
HWY_INLINE Triple<V> cross(const Triple<V>& a, const Triple<V>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Condition, class V>
HWY_INLINE Triple<V> select(Condition condition, const Triple<V>& a, const Triple<V>& b) {
    return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z)};
}

template <class V>
HWY_INLINE Square<V> operator+(const Square<V>& a, const Square<V>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
HWY_INLINE Square<V> operator-(const Square<V>& a, const Square<V>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V>
HWY_INLINE Square<V> operator-(const Square<V>& a) {
    return {-a.x, -a.y, -a.z};
}
template <class V>
HWY_INLINE Square<V> operator*(V s, const Square<V>& a) {
    return {s * a.x, s * a.y, s * a.z};
}
template <class V>
HWY_INLINE Triple<V> operator*(const Square<V>& a, const Triple<V>& b) {
    return {dot(a.x, b), dot(a.y, b), dot(a.z, b)};
}
template <class V>
HWY_INLINE Triple<V> diagonal_of(const Square<V>& a) {
    return {a.x.x, a.y.y, a.z.z};
}
template <class V>
HWY_INLINE Square<V> transposed(const Square<V>& a) {
    return {{a.x.x, a.y.x, a.z.x}, {a.x.y, a.y.y, a.z.y}, {a.x.z, a.y.z, a.z.z}};
}
/// Returns a^T b without the transpose.
template <class V>
HWY_INLINE Triple<V> transposed_times(const Square<V>& a, const Triple<V>& b) {
    return b.x * a.x + b.y * a.y + b.z * a.z;
}
template <class V>
HWY_INLINE Triple<V> row_times(const Triple<V>& row, const Square<V>& b) {
    return transposed_times(b, row);
}
template <class V>
HWY_INLINE Square<V> operator*(const Square<V>& a, const Square<V>& b) {
    return {row_times(a.x, b), row_times(a.y, b), row_times(a.z, b)};
}
/// Returns a b^T.
template <class V>
HWY_INLINE Square<V> outer(const Triple<V>& a, const Triple<V>& b) {
    return {a.x * b, a.y * b, a.z * b};
}
template <class V>
HWY_INLINE Square<V> plus_diagonal(const Square<V>& a, V s) {
    return {{a.x.x + s, a.x.y, a.x.z}, {a.y.x, a.y.y + s, a.y.z}, {a.z.x, a.z.y, a.z.z + s}};
}
/// Returns the matrix of a multiple and a cross product: it maps b to s b + w x b.
template <class V>
HWY_INLINE Square<V> scaling_and_cross(V s, const Triple<V>& w) {
    return {{s, -w.z, w.y}, {w.z, s, -w.x}, {-w.y, w.x, s}};
}
/// Returns a + w^, where w^ b = w x b; nothing is added to the diagonal.
template <class V>
HWY_INLINE Square<V> plus_cross(const Square<V>& a, const Triple<V>& w) {
    return {{a.x.x, a.x.y - w.z, a.x.z + w.y},
            {a.y.x + w.z, a.y.y, a.y.z - w.x},
            {a.z.x - w.y, a.z.y + w.x, a.z.z}};
}

/// Returns a place from which a body has moved.
template <class V>
HWY_INLINE Triple<V> moved(const Triple<V>& place, const Triple<V>& by) {
    return place + by;
}
template <class Tag>
HWY_INLINE Triple<Wide<Tag>> moved(const Triple<Wide<Tag>>& place, const Triple<Lanes<Tag>>& by) {
    return {place.x + by.x, place.y + by.y, place.z + by.z};
}

/// Returns the inverse by the adjugate, with one division: for matrices whose symmetric part is positive
/// definite, as their determinant then is.
template <class V>
HWY_INLINE Square<V> inverse(const Square<V>& a) {
    const Triple<V> first = cross(a.y, a.z);
    const V scale = V(1.0) / dot(a.x, first);
    return transposed(Square<V>{scale * first, scale * cross(a.z, a.x), scale * cross(a.x, a.y)});
}

/// Returns (1 + w^)^-1 a for a vector w.
template <class V>
HWY_INLINE Triple<V> rotated_back(const Triple<V>& w, const Triple<V>& a) {
    const V scale = V(1.0) / (V(1.0) + dot(w, w));
    return scale * (a - cross(w, a) + dot(w, a) * w);
}

/// A quaternion (w, x, y, z).
template <class V>
struct Quaternion {
    V w;
    Triple<V> v;
};
template <class V>
HWY_INLINE Square<V> rotation_matrix(const Quaternion<V>& q) {
    if constexpr (is_packed<V>) {
        return rotation_matrix(q.w, q.v);
    } else {
        const V two(2.0);
        const V x = two * q.v.x;
        const V y = two * q.v.y;
        const V z = two * q.v.z;
        const V xx = q.v.x * x;
        const V yy = q.v.y * y;
        const V zz = q.v.z * z;
        const V xy = q.v.x * y;
        const V xz = q.v.x * z;
        const V yz = q.v.y * z;
        const V wx = q.w * x;
        const V wy = q.w * y;
        const V wz = q.w * z;
        const V one(1.0);
        return {{one - (yy + zz), xy - wz, xz + wy},
                {xy + wz, one - (xx + zz), yz - wx},
                {xz - wy, yz + wx, one - (xx + yy)}};
    }
}
/// Returns q (1, half), to unit length: Cayley's map of the rotation 2 half in body axes.
template <class V>
HWY_INLINE Quaternion<V> rotated_by(const Quaternion<V>& q, const Triple<V>& half) {
    const V w = q.w - dot(q.v, half);
    const Triple<V> v = q.v + q.w * half + cross(q.v, half);
    const V scale = V(1.0) / root(w * w + dot(v, v));
    return {w * scale, scale * v};
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
