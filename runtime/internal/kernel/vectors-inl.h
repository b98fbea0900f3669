// Vectors and 3x3 matrices of the step's numbers.
// Included once for each instruction set (Highway), hence no plain include guard.
#if defined(SAMARA_VECTORS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SAMARA_VECTORS_INL_H
#undef SAMARA_VECTORS_INL_H
#else
#define SAMARA_VECTORS_INL_H
#endif

#include "internal/kernel/numbers-inl.h"
#include "internal/kernel/triple.hpp"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

/// Every lane the same.
template <class V, class Real>
HWY_INLINE Triple<V> broadcast(const Triple<Real>& a) {
    return {V(a.x), V(a.y), V(a.z)};
}
template <class V, class Real>
HWY_INLINE Square<V> broadcast(const Square<Real>& a) {
    return {broadcast<V>(a.x), broadcast<V>(a.y), broadcast<V>(a.z)};
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
HWY_INLINE Square<V> transposed(const Square<V>& a) {
    return {{a.x.x, a.y.x, a.z.x}, {a.x.y, a.y.y, a.z.y}, {a.x.z, a.y.z, a.z.z}};
}
/// a^T b without the transpose.
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
/// a b^T.
template <class V>
HWY_INLINE Square<V> outer(const Triple<V>& a, const Triple<V>& b) {
    return {a.x * b, a.y * b, a.z * b};
}
template <class V>
HWY_INLINE Square<V> plus_diagonal(const Square<V>& a, V s) {
    return {{a.x.x + s, a.x.y, a.x.z}, {a.y.x, a.y.y + s, a.y.z}, {a.z.x, a.z.y, a.z.z + s}};
}
/// The matrix of a multiple and a cross product: it takes b to s b + w x b.
template <class V>
HWY_INLINE Square<V> scaling_and_cross(V s, const Triple<V>& w) {
    return {{s, -w.z, w.y}, {w.z, s, -w.x}, {-w.y, w.x, s}};
}
/// a + w^, where w^ b = w x b; nothing is added to the diagonal.
template <class V>
HWY_INLINE Square<V> plus_cross(const Square<V>& a, const Triple<V>& w) {
    return {{a.x.x, a.x.y - w.z, a.x.z + w.y},
            {a.y.x + w.z, a.y.y, a.y.z - w.x},
            {a.z.x - w.y, a.z.y + w.x, a.z.z}};
}

/// L U = a without pivoting, for matrices whose symmetric part is positive definite: their pivots are never
/// zero. The reciprocals of U's diagonal stand on the diagonal.
template <class V>
HWY_INLINE Square<V> factorised(const Square<V>& a) {
    const V p = V(1.0) / a.x.x;
    const V yx = a.y.x * p;
    const V zx = a.z.x * p;
    const V q = V(1.0) / (a.y.y - yx * a.x.y);
    const V yz = a.y.z - yx * a.x.z;
    const V zy = (a.z.y - zx * a.x.y) * q;
    const V r = V(1.0) / (a.z.z - zx * a.x.z - zy * yz);
    return {{p, a.x.y, a.x.z}, {yx, q, yz}, {zx, zy, r}};
}
template <class V>
HWY_INLINE Triple<V> solved(const Square<V>& factors, const Triple<V>& b) {
    const V y = b.y - factors.y.x * b.x;
    const V z = b.z - factors.z.x * b.x - factors.z.y * y;
    Triple<V> x;
    x.z = z * factors.z.z;
    x.y = (y - factors.y.z * x.z) * factors.y.y;
    x.x = (b.x - factors.x.y * x.y - factors.x.z * x.z) * factors.x.x;
    return x;
}

/// (1 + w^)^-1 a for a vector w.
template <class V>
HWY_INLINE Triple<V> turned_back(const Triple<V>& w, const Triple<V>& a) {
    const V scale = V(1.0) / (V(1.0) + dot(w, w));
    return scale * (a - cross(w, a) + dot(w, a) * w);
}

/// A quaternion (w, x, y, z).
template <class V>
struct Turn {
    V w;
    Triple<V> v;
};
template <class V>
HWY_INLINE Square<V> rotation_matrix(const Turn<V>& q) {
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
/// q (1, half), to unit length: Cayley's map of the turn 2 half in body axes.
template <class V>
HWY_INLINE Turn<V> turned_by(const Turn<V>& q, const Triple<V>& half) {
    const V w = q.w - dot(q.v, half);
    const Triple<V> v = q.v + q.w * half + cross(q.v, half);
    const V scale = V(1.0) / root(w * w + dot(v, v));
    return {w * scale, scale * v};
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
