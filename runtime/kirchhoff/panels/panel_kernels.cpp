#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "samara/kirchhoff/panels/panel_kernels.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, which includes this file again for each target.
#include <hwy/highway.h>

#include "samara/kirchhoff/panels/panel_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, group_size>;
using Doubles = hn::CappedTag<double, 8>;

/// Returns 1 / sqrt(x) to the last bits of single precision: Newton's step doubles the digits of the
/// estimate.
template <class V>
HWY_INLINE V inverse_root(Floats tag, V x) {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
    return hn::Div(hn::Set(tag, 1.0F), hn::Sqrt(x));  // the estimate there has five bits
#else
    const auto three_halves = hn::Set(tag, 1.5F);
    const auto half_x = hn::Mul(hn::Set(tag, 0.5F), x);
    auto y = hn::ApproximateReciprocalSqrt(x);
    y = hn::Mul(y, hn::NegMulAdd(hn::Mul(half_x, y), y, three_halves));
#if !HWY_ARCH_X86
    // There the estimate may have as few as eight bits.
    y = hn::Mul(y, hn::NegMulAdd(hn::Mul(half_x, y), y, three_halves));
#endif
    return y;
#endif
}

template <class V>
HWY_INLINE V inverse_root(Doubles tag, V x) {
    return hn::Div(hn::Set(tag, 1.0), hn::Sqrt(x));
}

template <class D, class Real>
HWY_INLINE hn::Vec<D> dot(D tag, const std::array<Real, 3>& a, hn::Vec<D> x, hn::Vec<D> y, hn::Vec<D> z) {
    return hn::MulAdd(hn::Set(tag, a[0]), x,
                      hn::MulAdd(hn::Set(tag, a[1]), y, hn::Mul(hn::Set(tag, a[2]), z)));
}

/// The sums over one panel's points at one vector of nodes: six node functions, then the three components of
/// the potential.
template <class D>
struct Sums {
    hn::Vec<D> f0, f1, f2, f3, f4, f5, px, py, pz;
};

template <class D, class Real = hn::TFromD<D>>
HWY_INLINE Sums<D> sum_points(D tag, const std::array<Real, 6>* functions, const SourcePoint<Real>* sources,
                              std::size_t points, hn::Vec<D> x, hn::Vec<D> y, hn::Vec<D> z) {
    const auto zero = hn::Zero(tag);
    Sums<D> s{zero, zero, zero, zero, zero, zero, zero, zero, zero};
    for (std::size_t i = 0; i < points; ++i) {
        const SourcePoint<Real>& source = sources[i];
        const auto dx = hn::Sub(hn::Set(tag, source.place[0]), x);
        const auto dy = hn::Sub(hn::Set(tag, source.place[1]), y);
        const auto dz = hn::Sub(hn::Set(tag, source.place[2]), z);
        const auto squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
        const auto inverse = inverse_root(tag, squared);
        const auto along = dot(tag, source.normal, dx, dy, dz);
        const auto value = hn::Mul(hn::Mul(along, inverse), hn::Mul(inverse, inverse));
        const std::array<Real, 6>& f = functions[i];
        s.f0 = hn::MulAdd(value, hn::Set(tag, f[0]), s.f0);
        s.f1 = hn::MulAdd(value, hn::Set(tag, f[1]), s.f1);
        s.f2 = hn::MulAdd(value, hn::Set(tag, f[2]), s.f2);
        s.f3 = hn::MulAdd(value, hn::Set(tag, f[3]), s.f3);
        s.f4 = hn::MulAdd(value, hn::Set(tag, f[4]), s.f4);
        s.f5 = hn::MulAdd(value, hn::Set(tag, f[5]), s.f5);
        s.px = hn::MulAdd(inverse, hn::Set(tag, source.moment[0]), s.px);
        s.py = hn::MulAdd(inverse, hn::Set(tag, source.moment[1]), s.py);
        s.pz = hn::MulAdd(inverse, hn::Set(tag, source.moment[2]), s.pz);
    }
    return s;
}

template <class V>
HWY_INLINE void add_to(Floats tag, V value, float* place) {
    hn::Store(hn::Add(hn::Load(tag, place), value), tag, place);
}

/// Adds the float sums over several panels to the double ones.
void flush(std::array<std::array<float, group_size>, 3>& parts, GroupPotentials& potentials) {
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t i = 0; i < group_size; ++i) {
            potentials[k][i] += static_cast<double>(parts[k][i]);
            parts[k][i] = 0.0F;
        }
    }
}

void add_far_panels(const SourcePoints<float>& sources, const std::vector<CurvedPanel>& panels,
                    const std::vector<std::uint32_t>& list, const NodeGroup<float>& group, float* rows,
                    GroupPotentials& potentials) {
    constexpr std::size_t panels_a_flush = 16;
    const Floats tag;
    alignas(64) std::array<std::array<float, group_size>, 3> parts{};
    for (std::size_t entry = 0; entry < list.size(); ++entry) {
        const CurvedPanel& panel = panels[list[entry]];
        const SourcePoint<float>* points = sources.sources.data() + list[entry] * sources.points;
        for (std::size_t i = 0; i < group_size; i += hn::Lanes(tag)) {
            const auto s =
                sum_points(tag, sources.functions.data(), points, sources.points, hn::Load(tag, &group.x[i]),
                           hn::Load(tag, &group.y[i]), hn::Load(tag, &group.z[i]));
            const auto row = [&](std::size_t a) {
                return rows + static_cast<std::size_t>(panel.nodes[a]) * group_size + i;
            };
            add_to(tag, s.f0, row(0));
            add_to(tag, s.f1, row(1));
            add_to(tag, s.f2, row(2));
            add_to(tag, s.f3, row(3));
            add_to(tag, s.f4, row(4));
            add_to(tag, s.f5, row(5));
            add_to(tag, s.px, &parts[0][i]);
            add_to(tag, s.py, &parts[1][i]);
            add_to(tag, s.pz, &parts[2][i]);
        }
        if (entry % panels_a_flush == panels_a_flush - 1) flush(parts, potentials);
    }
    flush(parts, potentials);
}

void add_near_panel(const SourcePoints<double>& sources, const std::vector<CurvedPanel>& panels,
                    std::size_t panel, const NodeGroup<double>& group,
                    const std::array<double, group_size>& share, float* rows, GroupPotentials& potentials) {
    const Doubles tag;
    const hn::Rebind<float, Doubles> narrow;
    const SourcePoint<double>* points = sources.sources.data() + panel * sources.points;
    for (std::size_t i = 0; i < group_size; i += hn::Lanes(tag)) {
        const auto s =
            sum_points(tag, sources.functions.data(), points, sources.points, hn::Load(tag, &group.x[i]),
                       hn::Load(tag, &group.y[i]), hn::Load(tag, &group.z[i]));
        // Where the panel's own nodes are among the points, the sums there are not finite.
        const auto wanted = hn::Gt(hn::LoadU(tag, &share[i]), hn::Zero(tag));
        const auto add_row = [&](std::size_t a, auto value) {
            float* row = rows + static_cast<std::size_t>(panels[panel].nodes[a]) * group_size + i;
            const auto entry = hn::DemoteTo(narrow, hn::IfThenElseZero(wanted, value));
            hn::Store(hn::Add(hn::Load(narrow, row), entry), narrow, row);
        };
        const auto add_potential = [&](std::size_t k, auto value) {
            double* place = &potentials[k][i];
            hn::StoreU(hn::Add(hn::LoadU(tag, place), hn::IfThenElseZero(wanted, value)), tag, place);
        };
        add_row(0, s.f0);
        add_row(1, s.f1);
        add_row(2, s.f2);
        add_row(3, s.f3);
        add_row(4, s.f4);
        add_row(5, s.f5);
        add_potential(0, s.px);
        add_potential(1, s.py);
        add_potential(2, s.pz);
    }
}

void add_piece(const TriangleRule& rule, const PanelPiece& piece, const CurvedPanel& panel,
               const Vector3d& node, PolynomialSums& sums) {
    constexpr double quarter_pi_inverse = 0.07957747154594767;  // 1 / (4 pi)
    const Doubles tag;
    const auto set = [&](double value) { return hn::Set(tag, value); };
    const auto& c = panel.coefficients;
    const auto zero = hn::Zero(tag);
    auto s0 = zero, sp = zero, sq = zero, spp = zero, spq = zero, sqq = zero, sx = zero, sy = zero, sz = zero;
    const double scale =
        quarter_pi_inverse * (piece.side_p[0] * piece.side_q[1] - piece.side_p[1] * piece.side_q[0]);
    for (std::size_t i = 0; i < rule.weight.size(); i += hn::Lanes(tag)) {
        const auto u = hn::LoadU(tag, rule.p.data() + i);
        const auto v = hn::LoadU(tag, rule.q.data() + i);
        const auto weight = hn::Mul(hn::LoadU(tag, rule.weight.data() + i), set(scale));
        const auto p =
            hn::MulAdd(u, set(piece.side_p[0]), hn::MulAdd(v, set(piece.side_q[0]), set(piece.corner[0])));
        const auto q =
            hn::MulAdd(u, set(piece.side_p[1]), hn::MulAdd(v, set(piece.side_q[1]), set(piece.corner[1])));
        const auto two_p = hn::Add(p, p);
        const auto two_q = hn::Add(q, q);
        const auto place = [&](int k) {
            return hn::MulAdd(p, hn::MulAdd(p, set(c[3][k]), hn::MulAdd(q, set(c[4][k]), set(c[1][k]))),
                              hn::MulAdd(q, hn::MulAdd(q, set(c[5][k]), set(c[2][k])), set(c[0][k])));
        };
        const auto along_p = [&](int k) {
            return hn::MulAdd(two_p, set(c[3][k]), hn::MulAdd(q, set(c[4][k]), set(c[1][k])));
        };
        const auto along_q = [&](int k) {
            return hn::MulAdd(two_q, set(c[5][k]), hn::MulAdd(p, set(c[4][k]), set(c[2][k])));
        };
        const auto px = along_p(0), py = along_p(1), pz = along_p(2);
        const auto qx = along_q(0), qy = along_q(1), qz = along_q(2);
        const auto nx = hn::Mul(weight, hn::MulSub(py, qz, hn::Mul(pz, qy)));
        const auto ny = hn::Mul(weight, hn::MulSub(pz, qx, hn::Mul(px, qz)));
        const auto nz = hn::Mul(weight, hn::MulSub(px, qy, hn::Mul(py, qx)));
        const auto x = place(0), y = place(1), z = place(2);
        const auto dx = hn::Sub(x, set(node[0]));
        const auto dy = hn::Sub(y, set(node[1]));
        const auto dz = hn::Sub(z, set(node[2]));
        const auto squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
        const auto inverse = inverse_root(tag, squared);
        const auto along = hn::MulAdd(nx, dx, hn::MulAdd(ny, dy, hn::Mul(nz, dz)));
        const auto value = hn::Mul(hn::Mul(along, inverse), hn::Mul(inverse, inverse));
        const auto value_p = hn::Mul(value, p);
        const auto value_q = hn::Mul(value, q);
        s0 = hn::Add(s0, value);
        sp = hn::Add(sp, value_p);
        sq = hn::Add(sq, value_q);
        spp = hn::MulAdd(value_p, p, spp);
        spq = hn::MulAdd(value_p, q, spq);
        sqq = hn::MulAdd(value_q, q, sqq);
        sx = hn::MulAdd(inverse, hn::MulSub(y, nz, hn::Mul(z, ny)), sx);
        sy = hn::MulAdd(inverse, hn::MulSub(z, nx, hn::Mul(x, nz)), sy);
        sz = hn::MulAdd(inverse, hn::MulSub(x, ny, hn::Mul(y, nx)), sz);
    }
    const auto add = [&](std::size_t k, auto value) {
        hn::Store(hn::Add(hn::Load(tag, sums.lanes[k].data()), value), tag, sums.lanes[k].data());
    };
    add(0, s0);
    add(1, sp);
    add(2, sq);
    add(3, spp);
    add(4, spq);
    add(5, sqq);
    add(6, sx);
    add(7, sy);
    add(8, sz);
}

void multiply_group(const float* rows, std::size_t count, const double* columns, double* product) {
    const Doubles tag;
    const hn::Rebind<float, Doubles> narrow;
    const std::size_t lanes = hn::Lanes(tag);
    for (std::size_t i = 0; i < group_size; i += 2 * lanes) {
        auto a0 = hn::Zero(tag), a1 = a0, a2 = a0, a3 = a0, a4 = a0, a5 = a0;
        auto b0 = a0, b1 = a0, b2 = a0, b3 = a0, b4 = a0, b5 = a0;
        const float* entry = rows + i;
        const double* column = columns;
        for (std::size_t j = 0; j < count; ++j, entry += group_size, column += 6) {
            const auto a = hn::PromoteTo(tag, hn::Load(narrow, entry));
            const auto b = hn::PromoteTo(tag, hn::Load(narrow, entry + lanes));
            const auto c0 = hn::Set(tag, column[0]), c1 = hn::Set(tag, column[1]),
                       c2 = hn::Set(tag, column[2]);
            const auto c3 = hn::Set(tag, column[3]), c4 = hn::Set(tag, column[4]),
                       c5 = hn::Set(tag, column[5]);
            a0 = hn::MulAdd(a, c0, a0);
            b0 = hn::MulAdd(b, c0, b0);
            a1 = hn::MulAdd(a, c1, a1);
            b1 = hn::MulAdd(b, c1, b1);
            a2 = hn::MulAdd(a, c2, a2);
            b2 = hn::MulAdd(b, c2, b2);
            a3 = hn::MulAdd(a, c3, a3);
            b3 = hn::MulAdd(b, c3, b3);
            a4 = hn::MulAdd(a, c4, a4);
            b4 = hn::MulAdd(b, c4, b4);
            a5 = hn::MulAdd(a, c5, a5);
            b5 = hn::MulAdd(b, c5, b5);
        }
        alignas(64) std::array<std::array<double, group_size>, 6> sums;
        const auto store = [&](std::size_t k, auto first, auto second) {
            hn::Store(first, tag, sums[k].data());
            hn::Store(second, tag, sums[k].data() + lanes);
            for (std::size_t r = 0; r < 2 * lanes; ++r) product[(i + r) * 6 + k] = sums[k][r];
        };
        store(0, a0, b0);
        store(1, a1, b1);
        store(2, a2, b2);
        store(3, a3, b3);
        store(4, a4, b4);
        store(5, a5, b5);
    }
}

void row_sums(const float* rows, std::size_t count, double* sums) {
    const Doubles tag;
    const hn::Rebind<float, Doubles> narrow;
    for (std::size_t i = 0; i < group_size; i += hn::Lanes(tag)) {
        auto even = hn::Zero(tag), odd = even;
        std::size_t j = 0;
        for (; j + 1 < count; j += 2) {
            even = hn::Add(even, hn::PromoteTo(tag, hn::Load(narrow, rows + j * group_size + i)));
            odd = hn::Add(odd, hn::PromoteTo(tag, hn::Load(narrow, rows + (j + 1) * group_size + i)));
        }
        if (j < count) even = hn::Add(even, hn::PromoteTo(tag, hn::Load(narrow, rows + j * group_size + i)));
        hn::StoreU(hn::Add(even, odd), tag, sums + i);
    }
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace samara {

HWY_EXPORT(add_far_panels);
HWY_EXPORT(add_near_panel);
HWY_EXPORT(add_piece);
HWY_EXPORT(multiply_group);
HWY_EXPORT(row_sums);

void add_far_panels(const SourcePoints<float>& sources, const std::vector<CurvedPanel>& panels,
                    const std::vector<std::uint32_t>& list, const NodeGroup<float>& group, float* rows,
                    GroupPotentials& potentials) {
    HWY_DYNAMIC_DISPATCH(add_far_panels)(sources, panels, list, group, rows, potentials);
}

void add_near_panel(const SourcePoints<double>& sources, const std::vector<CurvedPanel>& panels,
                    std::size_t panel, const NodeGroup<double>& group,
                    const std::array<double, group_size>& share, float* rows, GroupPotentials& potentials) {
    HWY_DYNAMIC_DISPATCH(add_near_panel)(sources, panels, panel, group, share, rows, potentials);
}

void add_piece(const TriangleRule& rule, const PanelPiece& piece, const CurvedPanel& panel,
               const Vector3d& node, PolynomialSums& sums) {
    HWY_DYNAMIC_DISPATCH(add_piece)(rule, piece, panel, node, sums);
}

void multiply_group(const float* rows, std::size_t count, const double* columns, double* product) {
    HWY_DYNAMIC_DISPATCH(multiply_group)(rows, count, columns, product);
}

std::array<double, group_size> row_sums(const float* rows, std::size_t count) {
    std::array<double, group_size> sums{};
    HWY_DYNAMIC_DISPATCH(row_sums)(rows, count, sums.data());
    return sums;
}

}  // namespace samara
#endif
