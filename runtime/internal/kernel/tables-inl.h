// Look-up of a table by direction and Reynolds number.
// Included once for each instruction set (Highway), hence no plain include guard.
#if defined(SAMARA_TABLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SAMARA_TABLES_INL_H
#undef SAMARA_TABLES_INL_H
#else
#define SAMARA_TABLES_INL_H
#endif

#include "internal/kernel/flight_constants.hpp"
#include "internal/kernel/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

/// Four numbers of a table's rows.
template <class V>
struct Quad {
    V a, b, c, d;
};

/// A place in a table: the first of its four corners (its first number's index), the corners' weights, and
/// the way from this plane to the next.
template <class V>
struct Place;

template <>
struct Place<double> {
    std::int32_t index;
    double weights[4];
    double plane_fraction;
};

template <class Tag>
struct Place<Lanes<Tag>> {
    HWY_ALIGN_MAX std::int32_t index[hn::MaxLanes(Tag())];
    HWY_ALIGN_MAX hn::TFromD<Tag> weights[4][hn::MaxLanes(Tag())];
    Lanes<Tag> plane_fraction;
};

HWY_INLINE void keep_index(double index, Place<double>& place) {
    place.index = static_cast<std::int32_t>(index);
}
template <class Tag>
HWY_INLINE void keep_index(Lanes<Tag> index, Place<Lanes<Tag>>& place) {
    const hn::Rebind<std::int32_t, Tag> integers;
    if constexpr (sizeof(hn::TFromD<Tag>) == 4) {
        hn::Store(hn::ConvertTo(integers, index.raw), integers, place.index);
    } else {
        hn::Store(hn::DemoteTo(integers, index.raw), integers, place.index);
    }
}
HWY_INLINE void keep_weight(double weight, int corner, Place<double>& place) {
    place.weights[corner] = weight;
}
template <class Tag>
HWY_INLINE void keep_weight(Lanes<Tag> weight, int corner, Place<Lanes<Tag>>& place) {
    hn::Store(weight.raw, Tag(), place.weights[corner]);
}

/// The cell of a place along one axis, from 0 to `last`, and how far into it the place lies. NaN goes to 0.
template <class V>
HWY_INLINE V cell_of(V place, V last, V& fraction) {
    const V cell = smaller(last, larger(V(0.0), whole_part(place)));
    fraction = smaller(V(1.0), larger(V(0.0), place - cell));
    return cell;
}

/// octahedral_map.hpp and load_tables.hpp say what this does.
template <class V, class Real>
HWY_INLINE void find_place(const DirectionTable<Real>& table, const Triple<V>& direction, V reynolds_number,
                           Place<V>& place) {
    const V zero(0.0);
    const V one(1.0);
    const Triple<V> d = table.turned ? broadcast<V>(table.to_map_axes) * direction : direction;
    const V norm = larger(magnitude(d.x) + magnitude(d.y) + magnitude(d.z), V(tiny<V>));
    const V inverse = one / norm;
    const V x = d.x * inverse;
    const V y = d.y * inverse;
    const auto below = d.z < zero;
    const V folded_x = (one - magnitude(y)) * select(x < zero, -one, one);
    const V folded_y = (one - magnitude(x)) * select(y < zero, -one, one);
    const V half_side(0.5 * (table.side - 1));
    const V last(table.side - 2.0);
    V across;
    V down;
    const V column = cell_of((select(below, folded_x, x) + one) * half_side, last, across);
    const V row = cell_of((select(below, folded_y, y) + one) * half_side, last, down);

    V plane = zero;
    place.plane_fraction = zero;
    if (table.planes() > 1) {
        const V logarithm_here = logarithm(larger(V(tiny<V>), reynolds_number));
        place.plane_fraction = (logarithm_here - V(table.logarithms[0])) * V(table.inverse_differences[0]);
        for (std::size_t i = 1; i + 1 < table.logarithms.size(); ++i) {
            const auto beyond = V(table.logarithms[i]) < logarithm_here;
            plane = select(beyond, V(static_cast<double>(i)), plane);
            place.plane_fraction =
                select(beyond, (logarithm_here - V(table.logarithms[i])) * V(table.inverse_differences[i]),
                       place.plane_fraction);
        }
        place.plane_fraction = smaller(one, larger(zero, place.plane_fraction));
    }
    keep_index(((plane * V(table.side) + row) * V(table.side) + column) * V(table.width), place);
    keep_weight((one - down) * (one - across), 0, place);
    keep_weight((one - down) * across, 1, place);
    keep_weight(down * (one - across), 2, place);
    keep_weight(down * across, 3, place);
}

/// The first `quads` fours of numbers at the place's corners, weighted.
template <int quads>
HWY_INLINE void corners_sum(const double* numbers, std::ptrdiff_t right, std::ptrdiff_t down,
                            const Place<double>& place, Quad<double>* sums) {
    const double* n = numbers + place.index;
    const auto sum = [&](int i) {
        return n[i] * place.weights[0] + n[i + right] * place.weights[1] + n[i + down] * place.weights[2] +
               n[i + down + right] * place.weights[3];
    };
    for (int quad = 0; quad < quads; ++quad) {
        sums[quad] = {sum(4 * quad), sum(4 * quad + 1), sum(4 * quad + 2), sum(4 * quad + 3)};
    }
}

#if HWY_TARGET == HWY_SCALAR
template <class Tag, class Real = hn::TFromD<Tag>>
HWY_INLINE Quad<Lanes<Tag>> fields_of(const Real* rows) {
    return {Lanes<Tag>(hn::Set(Tag(), rows[0])), Lanes<Tag>(hn::Set(Tag(), rows[1])),
            Lanes<Tag>(hn::Set(Tag(), rows[2])), Lanes<Tag>(hn::Set(Tag(), rows[3]))};
}
template <class Piece, class Real = hn::TFromD<Piece>>
HWY_INLINE void keep_pieces(Piece piece, hn::Vec<Piece> sum, std::size_t number, Real* rows,
                            std::size_t /*lane*/, std::size_t /*lanes*/) {
    hn::Store(sum, piece, rows + number);
}
#else
/// The fields of rows that stand as transposed blocks: rows[i] holds, for each block b of lanes, the numbers
/// of its i-th lane.
template <class Tag>
HWY_INLINE Quad<Lanes<Tag>> fields_of(const float* rows) {
    const Tag tag;
    const hn::Repartition<std::uint64_t, Tag> pairs;
    const std::size_t n = hn::Lanes(tag);
    const auto r0 = hn::Load(tag, rows);
    const auto r1 = hn::Load(tag, rows + n);
    const auto r2 = hn::Load(tag, rows + 2 * n);
    const auto r3 = hn::Load(tag, rows + 3 * n);
    const auto low01 = hn::BitCast(pairs, hn::InterleaveLower(tag, r0, r1));
    const auto low23 = hn::BitCast(pairs, hn::InterleaveLower(tag, r2, r3));
    const auto high01 = hn::BitCast(pairs, hn::InterleaveUpper(tag, r0, r1));
    const auto high23 = hn::BitCast(pairs, hn::InterleaveUpper(tag, r2, r3));
    return {hn::BitCast(tag, hn::InterleaveLower(pairs, low01, low23)),
            hn::BitCast(tag, hn::InterleaveUpper(pairs, low01, low23)),
            hn::BitCast(tag, hn::InterleaveLower(pairs, high01, high23)),
            hn::BitCast(tag, hn::InterleaveUpper(pairs, high01, high23))};
}
template <class Tag>
HWY_INLINE Quad<Lanes<Tag>> fields_of(const double* rows) {
    const Tag tag;
    const std::size_t n = hn::Lanes(tag);
    const auto first0 = hn::Load(tag, rows);
    const auto second0 = hn::Load(tag, rows + n);
    const auto first1 = hn::Load(tag, rows + 2 * n);
    const auto second1 = hn::Load(tag, rows + 3 * n);
    return {hn::InterleaveLower(tag, first0, first1), hn::InterleaveUpper(tag, first0, first1),
            hn::InterleaveLower(tag, second0, second1), hn::InterleaveUpper(tag, second0, second1)};
}

/// Where the numbers of one lane go so that fields_of finds them: in blocks of the 128 bits within which
/// Highway interleaves.
template <class Real>
HWY_INLINE Real* piece_of_lane(Real* rows, std::size_t lane, std::size_t lanes, std::size_t number) {
    constexpr std::size_t block = 16 / sizeof(Real);
    const std::size_t in_block = lane % block;
    const std::size_t row = in_block * (4 / block) + number / block;
    return rows + row * lanes + (lane - in_block);
}
/// Keeps a lane's numbers from `number` on, a piece of 16 bytes at a time.
template <class Piece, class Real = hn::TFromD<Piece>>
HWY_INLINE void keep_pieces(Piece piece, hn::Vec<Piece> sum, std::size_t number, Real* rows, std::size_t lane,
                            std::size_t lanes) {
    constexpr std::size_t half = hn::MaxLanes(Piece()) / 2;
    if constexpr (half * sizeof(Real) >= 16) {
        const hn::Half<Piece> halves;
        keep_pieces(halves, hn::LowerHalf(halves, sum), number, rows, lane, lanes);
        keep_pieces(halves, hn::UpperHalf(halves, sum), number + half, rows, lane, lanes);
    } else {
        Real* quad = rows + number / 4 * (4 * lanes);
        hn::Store(sum, piece, piece_of_lane(quad, lane, lanes, number % 4));
    }
}

#endif

template <int quads, class Tag, class Real = hn::TFromD<Tag>>
HWY_INLINE void corners_sum(const Real* numbers, std::ptrdiff_t right, std::ptrdiff_t down,
                            const Place<Lanes<Tag>>& place, Quad<Lanes<Tag>>* sums) {
    const hn::CappedTag<Real, std::size_t{4} * quads> piece;
    constexpr std::size_t step = hn::MaxLanes(piece);
    const std::size_t lanes = hn::Lanes(Tag());
    HWY_ALIGN_MAX Real rows[quads * 4 * hn::MaxLanes(Tag())];
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const Real* n = numbers + place.index[lane];
        const auto w0 = hn::Set(piece, place.weights[0][lane]);
        const auto w1 = hn::Set(piece, place.weights[1][lane]);
        const auto w2 = hn::Set(piece, place.weights[2][lane]);
        const auto w3 = hn::Set(piece, place.weights[3][lane]);
        for (std::size_t i = 0; i < std::size_t{4} * quads; i += step) {
            auto sum = hn::Mul(hn::LoadU(piece, n + i), w0);
            sum = hn::Add(sum, hn::Mul(hn::LoadU(piece, n + i + right), w1));
            sum = hn::Add(sum, hn::Mul(hn::LoadU(piece, n + i + down), w2));
            sum = hn::Add(sum, hn::Mul(hn::LoadU(piece, n + i + down + right), w3));
            keep_pieces(piece, sum, i, rows, lane, lanes);
        }
    }
    for (std::size_t quad = 0; quad < quads; ++quad) sums[quad] = fields_of<Tag>(rows + quad * 4 * lanes);
}

/// The first `quads` fours of the rows' numbers, interpolated.
template <int quads, class V, class Real>
HWY_INLINE void look_up(const DirectionTable<Real>& table, const Place<V>& place, Quad<V>* result) {
    const std::ptrdiff_t right = table.width;
    const std::ptrdiff_t down = right * table.side;
    const Real* numbers = table.rows.data();
    corners_sum<quads>(numbers, right, down, place, result);
    if (table.planes() < 2) return;
    Quad<V> next[quads];
    corners_sum<quads>(numbers + down * table.side, right, down, place, next);
    const V f = place.plane_fraction;
    const V g = V(1.0) - f;
    for (int i = 0; i < quads; ++i) {
        const Quad<V>& here = result[i];
        result[i] = {g * here.a + f * next[i].a, g * here.b + f * next[i].b, g * here.c + f * next[i].c,
                     g * here.d + f * next[i].d};
    }
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
