#include "samara/kirchhoff/panels/flat_triangle_integrals.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "samara/kirchhoff/panels/flat_triangle_integrals.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep
//
#include <hwy/contrib/math/math-inl.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, point_batch>;
using Lanes = hn::Vec<Tag>;

constexpr double tiny = 1e-300;

/// Three coordinates of as many points as there are lanes.
struct Points {
    Lanes x;
    Lanes y;
    Lanes z;
};

HWY_INLINE Points minus(const Vector3d& a, const Points& b) {
    const Tag tag;
    return {hn::Sub(hn::Set(tag, a.x()), b.x), hn::Sub(hn::Set(tag, a.y()), b.y),
            hn::Sub(hn::Set(tag, a.z()), b.z)};
}

HWY_INLINE Lanes dot(const Points& a, const Points& b) {
    return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}

HWY_INLINE Lanes dot(const Vector3d& a, const Points& b) {
    const Tag tag;
    return hn::MulAdd(hn::Set(tag, a.x()), b.x,
                      hn::MulAdd(hn::Set(tag, a.y()), b.y, hn::Mul(hn::Set(tag, a.z()), b.z)));
}

HWY_INLINE Points load(const PointBatch& points, std::size_t i) {
    const Tag tag;
    return {hn::Load(tag, &points.x[i]), hn::Load(tag, &points.y[i]), hn::Load(tag, &points.z[i])};
}

/// Returns the angle of the point (x, y), y >= 0; 0 where y is 0.
HWY_INLINE Lanes angle(Lanes y, Lanes x) {
    const Tag tag;
    const auto flat = hn::Le(y, hn::Set(tag, tiny));
    const auto left = hn::Lt(x, hn::Zero(tag));
    const Lanes safe = hn::IfThenElse(hn::Eq(x, hn::Zero(tag)), hn::Set(tag, tiny), x);
    const Lanes principal = hn::Atan(tag, hn::Div(y, safe));
    constexpr double pi = 3.14159265358979323846;
    const Lanes whole = hn::IfThenElse(left, hn::Add(principal, hn::Set(tag, pi)), principal);
    return hn::IfThenElse(flat, hn::Zero(tag), whole);
}

/// A triangle seen from points: what all its integrals are made of.
struct View {
    Points arms[3];       // from the point to the corners
    Lanes distances[3];   // to the corners
    Lanes height;         // of the triangle's plane over the point, along the normal
    Lanes across[3];      // from the point's projection to the edges' lines, outward
    Lanes logarithms[3];  // integral of 1/r along the edges
    Lanes solid_angle;    // without a sign
};

HWY_INLINE Lanes edge_logarithm(Lanes r1, Lanes r2, double length) {
    const Tag tag;
    const Lanes sum = hn::Add(r1, r2);
    const Lanes edge = hn::Set(tag, length);
    // On the edge itself the logarithm is infinite, but all that it is multiplied with is zero.
    const Lanes below = hn::Max(hn::Sub(sum, edge), hn::Set(tag, 1e-17 * length));
    return hn::Log(tag, hn::Div(hn::Add(sum, edge), below));
}

HWY_INLINE View view(const FlatTriangle& triangle, const Points& points) {
    const Tag tag;
    View seen;
    for (std::size_t k = 0; k < 3; ++k) {
        seen.arms[k] = minus(triangle.corners[k], points);
        seen.distances[k] = hn::Sqrt(dot(seen.arms[k], seen.arms[k]));
    }
    seen.height = dot(triangle.normal, seen.arms[0]);
    for (std::size_t e = 0; e < 3; ++e) {
        seen.across[e] = dot(triangle.outward[e], seen.arms[e]);
        seen.logarithms[e] =
            edge_logarithm(seen.distances[e], seen.distances[(e + 1) % 3], triangle.lengths[e]);
    }
    const Lanes triple = hn::Mul(hn::Set(tag, 2.0 * triangle.area), hn::Abs(seen.height));
    const Lanes r0 = seen.distances[0];
    const Lanes r1 = seen.distances[1];
    const Lanes r2 = seen.distances[2];
    const Lanes rest = hn::MulAdd(
        hn::MulAdd(r0, r1, dot(seen.arms[0], seen.arms[1])), r2,
        hn::MulAdd(dot(seen.arms[0], seen.arms[2]), r1, hn::Mul(dot(seen.arms[1], seen.arms[2]), r0)));
    seen.solid_angle = hn::Mul(hn::Set(tag, 2.0), angle(triple, rest));
    return seen;
}

HWY_INLINE Lanes potential(const View& seen) {
    Lanes sum = hn::Neg(hn::Mul(hn::Abs(seen.height), seen.solid_angle));
    for (std::size_t e = 0; e < 3; ++e) sum = hn::MulAdd(seen.across[e], seen.logarithms[e], sum);
    return sum;
}

void uniform_potential_lanes(const FlatTriangle& triangle, const PointBatch& points, ValueBatch& result) {
    const Tag tag;
    for (std::size_t i = 0; i < point_batch; i += hn::Lanes(tag)) {
        hn::Store(potential(view(triangle, load(points, i))), tag, &result.values[i]);
    }
}

/// Returns the angle whose tangent is y/x, x >= 0, up to a right one; 0 where y is 0.
HWY_INLINE Lanes acute_angle(Lanes y, Lanes x) {
    const Tag tag;
    return hn::Atan(tag, hn::Div(y, hn::Max(x, hn::Set(tag, tiny))));
}

/// Computes the sum over the triangle's edges of direction . outward times the integral of r - h log(r + h),
/// for points at the height h above its plane; terms that cancel around the triangle are left out.
void contour_potential_lanes(const FlatTriangle& triangle, const Vector3d& direction, double height,
                             const PointBatch& points, ValueBatch& result) {
    const Tag tag;
    const Lanes h = hn::Set(tag, height);
    for (std::size_t i = 0; i < point_batch; i += hn::Lanes(tag)) {
        const View seen = view(triangle, load(points, i));
        Lanes corner_logarithms[3];
        for (std::size_t k = 0; k < 3; ++k) {
            const Lanes above = hn::Max(hn::Add(seen.distances[k], h), hn::Set(tag, tiny));
            corner_logarithms[k] = hn::Log(tag, above);
        }
        Lanes sum = hn::Zero(tag);
        for (std::size_t e = 0; e < 3; ++e) {
            const std::size_t f = (e + 1) % 3;
            const Lanes from = dot(triangle.tangents[e], seen.arms[e]);
            const Lanes to = hn::Add(from, hn::Set(tag, triangle.lengths[e]));
            const Lanes across = seen.across[e];
            const Lanes across_squared = hn::Mul(across, across);
            const auto inner_angle = [&](Lanes s, Lanes r) HWY_ATTR {
                return acute_angle(hn::Mul(hn::Mul(s, across), hn::Sub(r, h)),
                                   hn::MulAdd(across_squared, r, hn::Mul(h, hn::Mul(s, s))));
            };
            const Lanes rotated =
                hn::Sub(inner_angle(to, seen.distances[f]), inner_angle(from, seen.distances[e]));
            const Lanes off = hn::MulAdd(h, h, across_squared);
            const Lanes distances =
                hn::MulAdd(to, seen.distances[f],
                           hn::NegMulAdd(from, seen.distances[e], hn::Mul(off, seen.logarithms[e])));
            const Lanes ends = hn::MulSub(to, corner_logarithms[f], hn::Mul(from, corner_logarithms[e]));
            const Lanes rest = hn::MulAdd(h, seen.logarithms[e], hn::MulAdd(across, rotated, ends));
            const Lanes whole = hn::NegMulAdd(h, rest, hn::Mul(hn::Set(tag, 0.5), distances));
            sum = hn::MulAdd(hn::Set(tag, direction.dot(triangle.outward[e])), whole, sum);
        }
        hn::Store(sum, tag, &result.values[i]);
    }
}

void add_hat_sums_lanes(const FlatTriangle& triangle, const SourceBatch& sources, HatSums& sums) {
    const Tag tag;
    const double inverse = 0.5 / triangle.area;
    // v_k falls from 1 at corner k to 0 across the edge opposite, along that edge's outward normal.
    double along[3][3];
    double slopes[3];
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t opposite = (k + 1) % 3;
        slopes[k] = -triangle.lengths[opposite] * inverse;
        for (std::size_t e = 0; e < 3; ++e) {
            along[k][e] = slopes[k] * triangle.outward[opposite].dot(triangle.outward[e]);
        }
    }
    Lanes potentials[3][3];
    Lanes angles[3][3];
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t a = 0; a < 3; ++a) potentials[k][a] = angles[k][a] = hn::Zero(tag);
    }
    for (std::size_t i = 0; i < point_batch; i += hn::Lanes(tag)) {
        const View seen = view(triangle, load(sources.points, i));
        const Lanes uniform = potential(seen);
        const Lanes signed_angle = hn::CopySign(seen.solid_angle, seen.height);
        const Lanes height_squared = hn::Mul(seen.height, seen.height);
        Lanes moments[3];  // edge integrals of r, whose sum along the outward normals is that of (y - x) / r
        for (std::size_t e = 0; e < 3; ++e) {
            const Lanes from = dot(triangle.tangents[e], seen.arms[e]);
            const Lanes to = hn::Add(from, hn::Set(tag, triangle.lengths[e]));
            const Lanes off = hn::MulAdd(seen.across[e], seen.across[e], height_squared);
            const Lanes ends = hn::MulSub(to, seen.distances[(e + 1) % 3], hn::Mul(from, seen.distances[e]));
            moments[e] = hn::Mul(hn::Set(tag, 0.5), hn::MulAdd(off, seen.logarithms[e], ends));
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const Lanes at_point = hn::Mul(hn::Set(tag, -slopes[k]), seen.across[(k + 1) % 3]);
            Lanes first = hn::Zero(tag);
            Lanes second = hn::Zero(tag);
            for (std::size_t e = 0; e < 3; ++e) {
                first = hn::MulAdd(hn::Set(tag, along[k][e]), moments[e], first);
                second = hn::MulAdd(hn::Set(tag, along[k][e]), seen.logarithms[e], second);
            }
            const Lanes hat_potential = hn::MulAdd(at_point, uniform, first);
            // The logarithms are multiplied with the height, which is zero where they are infinite.
            const Lanes hat_angle = hn::MulSub(at_point, signed_angle, hn::Mul(seen.height, second));
            for (std::size_t a = 0; a < 3; ++a) {
                const Lanes strength = hn::Load(tag, &sources.strengths[a].values[i]);
                potentials[k][a] = hn::MulAdd(hat_potential, strength, potentials[k][a]);
                angles[k][a] = hn::MulAdd(hat_angle, strength, angles[k][a]);
            }
        }
    }
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t a = 0; a < 3; ++a) {
            const auto row = static_cast<Eigen::Index>(k);
            const auto column = static_cast<Eigen::Index>(a);
            sums.potentials(row, column) += hn::GetLane(hn::SumOfLanes(tag, potentials[k][a]));
            sums.solid_angles(row, column) += hn::GetLane(hn::SumOfLanes(tag, angles[k][a]));
        }
    }
}

}  // namespace
}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace samara {

HWY_EXPORT(uniform_potential_lanes);
HWY_EXPORT(contour_potential_lanes);
HWY_EXPORT(add_hat_sums_lanes);

ValueBatch uniform_potential(const FlatTriangle& triangle, const PointBatch& points) {
    ValueBatch result;
    HWY_DYNAMIC_DISPATCH(uniform_potential_lanes)(triangle, points, result);
    return result;
}

ValueBatch contour_potential(const FlatTriangle& triangle, const Vector3d& direction, double height,
                             const PointBatch& points) {
    ValueBatch result;
    HWY_DYNAMIC_DISPATCH(contour_potential_lanes)(triangle, direction, height, points, result);
    return result;
}

void add_hat_sums(const FlatTriangle& triangle, const SourceBatch& sources, HatSums& sums) {
    HWY_DYNAMIC_DISPATCH(add_hat_sums_lanes)(triangle, sources, sums);
}

}  // namespace samara
#endif
