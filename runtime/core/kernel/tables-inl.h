// Look-up of a table by direction and Reynolds number.
// Included once for each instruction set (Highway), hence no plain include guard.
#if defined(SAMARA_TABLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SAMARA_TABLES_INL_H
#undef SAMARA_TABLES_INL_H
#else
#define SAMARA_TABLES_INL_H
#endif

#include "samara/core/kernel/step_constants.hpp"
#include "samara/core/kernel/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

/// The constants of a body in the precision of the numbers V.
template <class V>
using ConstantsOf = StepConstantsIn<RealOf<V>>;

/// Four numbers of a table's rows.
template <class V>
struct Quad {
    V a, b, c, d;
};

template <class V>
HWY_INLINE V first_of(const Quad<V>& numbers) {
    return numbers.a;
}
template <class V>
HWY_INLINE V second_of(const Quad<V>& numbers) {
    return numbers.b;
}
template <class V>
HWY_INLINE Triple<V> first_three(const Quad<V>& numbers) {
    return {numbers.a, numbers.b, numbers.c};
}

/// A place in a table: the first of its four corners (its first number's index), the corners' weights, and
/// the offset from this plane to the next. In single precision the weights are those of the sides of both
/// planes, and of the corners of a side.
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
    HWY_ALIGN_MAX hn::TFromD<Tag> weights[6][hn::MaxLanes(Tag())];
    Lanes<Tag> plane_fraction;
};

HWY_INLINE void keep_index(double index, Place<double>& place) {
    place.index = static_cast<std::int32_t>(index);
}
template <class Tag>
HWY_INLINE void keep_index(Lanes<Tag> index, Place<Lanes<Tag>>& place) {
    const hn::Rebind<std::int32_t, Tag> integers;
    if constexpr (in_single_precision<Lanes<Tag>>) {
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

#if SAMARA_PACKS_ONE_BODY
template <>
struct Quad<Spread> {
    Packed numbers;  // the fourth too
};
template <>
struct Place<Spread> {
    std::int32_t index;
    Spread weights[4];
    Spread plane_fraction;
};
#endif

/// Returns the cell of a place along one axis, from 0 to `last`, and the place within it. NaN goes to 0.
template <class V>
HWY_INLINE V cell_of(V place, V last, V& fraction) {
    const V cell = smaller(last, larger(V(0.0), whole_part(place)));
    fraction = smaller(V(1.0), larger(V(0.0), place - cell));
    return cell;
}

/// Returns the plane below a Reynolds number, and its place between that and the next.
template <class V>
HWY_INLINE V plane_of(const DirectionTable<RealOf<V>>& table, V reynolds_number, V& fraction) {
    const V zero(0.0);
    fraction = zero;
    if (table.planes() < 2) return zero;
    V plane = zero;
    V begin(table.logarithms[0]);
    V per_difference(table.inverse_differences[0]);
    for (std::size_t i = 1; i + 1 < table.logarithms.size(); ++i) {
        const auto beyond = V(table.reynolds_numbers[i]) < reynolds_number;
        plane = select(beyond, V(static_cast<double>(i)), plane);
        begin = select(beyond, V(table.logarithms[i]), begin);
        per_difference = select(beyond, V(table.inverse_differences[i]), per_difference);
    }
    const V logarithm_here = short_logarithm(larger(V(tiny<V>), reynolds_number));
    fraction = smaller(V(1.0), larger(zero, (logarithm_here - begin) * per_difference));
    return plane;
}

/// Finds the place of a direction, of any length, and a Reynolds number (octahedral_map.hpp,
/// load_tables.hpp).
template <class V>
HWY_INLINE void find_place(const DirectionTable<RealOf<V>>& table, const Triple<V>& direction,
                           V reynolds_number, Place<V>& place) {
    const V zero(0.0);
    const V one(1.0);
    const Triple<V> d = table.rotated ? broadcast<V>(table.to_map_axes) * direction : direction;
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

    const V plane = plane_of(table, reynolds_number, place.plane_fraction);
    keep_index(((plane * V(table.side) + row) * V(table.side) + column) * V(table.width), place);
    if constexpr (in_single_precision<V>) {
        const V next = place.plane_fraction;
        keep_weight((one - next) * (one - down), 0, place);
        keep_weight((one - next) * down, 1, place);
        keep_weight(next * (one - down), 2, place);
        keep_weight(next * down, 3, place);
        keep_weight(one - across, 4, place);
        keep_weight(across, 5, place);
    } else {
        keep_weight((one - down) * (one - across), 0, place);
        keep_weight((one - down) * across, 1, place);
        keep_weight(down * (one - across), 2, place);
        keep_weight(down * across, 3, place);
    }
}

/// Returns the first `quads` fours of numbers at the place's corners, weighted.
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
/// Returns the fields of rows that stand as transposed blocks: rows[i] holds, for each block b of lanes, the
/// numbers of its i-th lane.
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

template <class Tag>
HWY_INLINE Quad<Lanes<Tag>> fields_of(const float* rows) {
    const Tag tag;
    const hn::Repartition<double, Tag> pairs;
    const std::size_t n = hn::Lanes(tag);
    const auto interleaved = [&](std::size_t row, bool upper) HWY_ATTR {
        const auto a = hn::Load(tag, rows + row * n);
        const auto b = hn::Load(tag, rows + (row + 1) * n);
        return hn::BitCast(pairs, upper ? hn::InterleaveUpper(tag, a, b) : hn::InterleaveLower(tag, a, b));
    };
    const auto low01 = interleaved(0, false);
    const auto low23 = interleaved(2, false);
    const auto high01 = interleaved(0, true);
    const auto high23 = interleaved(2, true);
    return {hn::BitCast(tag, hn::InterleaveLower(pairs, low01, low23)),
            hn::BitCast(tag, hn::InterleaveUpper(pairs, low01, low23)),
            hn::BitCast(tag, hn::InterleaveLower(pairs, high01, high23)),
            hn::BitCast(tag, hn::InterleaveUpper(pairs, high01, high23))};
}

/// Returns the place of one lane's numbers for fields_of(): in blocks of the 128 bits within which Highway
/// interleaves.
template <class Real>
HWY_INLINE Real* piece_of_lane(Real* rows, std::size_t lane, std::size_t lanes, std::size_t number) {
    constexpr std::size_t block = 16 / sizeof(Real);
    const std::size_t in_block = lane % block;
    const std::size_t row = in_block * (4 / block) + number / block;
    return rows + row * lanes + (lane - in_block);
}
/// Stores a lane's numbers from `number` on, a piece of 16 bytes at a time.
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

template <int quads, class Tag>
HWY_INLINE void corners_sum(const double* numbers, std::ptrdiff_t right, std::ptrdiff_t down,
                            const Place<Lanes<Tag>>& place, Quad<Lanes<Tag>>* sums) {
    const hn::CappedTag<double, std::size_t{4} * quads> piece;
    constexpr std::size_t step = hn::MaxLanes(piece);
    const std::size_t lanes = hn::Lanes(Tag());
    HWY_ALIGN_MAX double rows[quads * 4 * hn::MaxLanes(Tag())];
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const double* n = numbers + place.index[lane];
        const auto weighted = [&](std::ptrdiff_t at, int corner) HWY_ATTR {
            return hn::Mul(hn::LoadU(piece, n + at), hn::Set(piece, place.weights[corner][lane]));
        };
        for (std::size_t number = 0; number < std::size_t{4} * quads; number += step) {
            const auto i = static_cast<std::ptrdiff_t>(number);
            auto sum = weighted(i, 0);
            sum = hn::Add(sum, weighted(i + right, 1));
            sum = hn::Add(sum, weighted(i + down, 2));
            sum = hn::Add(sum, weighted(i + down + right, 3));
            keep_pieces(piece, sum, number, rows, lane, lanes);
        }
    }
    for (std::size_t quad = 0; quad < quads; ++quad) sums[quad] = fields_of<Tag>(rows + quad * 4 * lanes);
}

/// Returns the first `quads` fours of the numbers of a table of that width, interpolated: a side's two
/// corners lie next to each other and are weighted at once, for both planes.
template <int quads, int width, class Tag>
HWY_INLINE void sides_sum(const float* numbers, std::ptrdiff_t down, std::ptrdiff_t next_plane,
                          const Place<Lanes<Tag>>& place, Quad<Lanes<Tag>>* sums) {
    const hn::CappedTag<float, std::size_t{2} * width> piece;
    constexpr std::size_t step = hn::MaxLanes(piece);
    const std::size_t lanes = hn::Lanes(Tag());
    HWY_ALIGN_MAX float rows[width * hn::MaxLanes(Tag())];
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        const auto sides = [&](std::size_t number) HWY_ATTR {
            const float* n = numbers + place.index[lane] + number;
            const auto weighted = [&](const float* from, int side) HWY_ATTR {
                return hn::Mul(hn::LoadU(piece, from), hn::Set(piece, place.weights[side][lane]));
            };
            auto sum = hn::Add(weighted(n, 0), weighted(n + down, 1));
            if (next_plane == 0) return sum;
            sum = hn::Add(sum, weighted(n + next_plane, 2));
            return hn::Add(sum, weighted(n + next_plane + down, 3));
        };
        const auto keep = [&](auto part, std::size_t number, auto left, auto right) HWY_ATTR {
            const auto sum = hn::Add(hn::Mul(left, hn::Set(part, place.weights[4][lane])),
                                     hn::Mul(right, hn::Set(part, place.weights[5][lane])));
            keep_pieces(part, sum, number, rows, lane, lanes);
        };
        if constexpr (step == std::size_t{2} * width) {
            const HalfOf<std::remove_const_t<decltype(piece)>> part;
            const auto both = sides(0);
            keep(part, 0, lower_half(part, both), upper_half(part, both));
        } else {
            for (std::size_t number = 0; number < std::size_t{4} * quads; number += step) {
                keep(piece, number, sides(number), sides(number + width));
            }
        }
    }
    for (std::size_t quad = 0; quad < quads; ++quad) sums[quad] = fields_of<Tag>(rows + quad * 4 * lanes);
}

/// Returns the first `quads` fours of the rows' numbers, interpolated.
template <int quads, class V>
HWY_INLINE void look_up(const DirectionTable<RealOf<V>>& table, const Place<V>& place, Quad<V>* result) {
    const std::ptrdiff_t right = table.width;
    const std::ptrdiff_t down = right * table.side;
    const std::ptrdiff_t next_plane = down * table.side;
    const RealOf<V>* numbers = table.numbers();
    if constexpr (in_single_precision<V>) {
        const std::ptrdiff_t other_plane = table.planes() < 2 ? 0 : next_plane;
        if (table.width == 4 * quads)
            return sides_sum<quads, 4 * quads>(numbers, down, other_plane, place, result);
        return sides_sum<quads, 8>(numbers, down, other_plane, place, result);
    } else {
        corners_sum<quads>(numbers, right, down, place, result);
        if (table.planes() < 2) return;
        Quad<V> next[quads];
        corners_sum<quads>(numbers + next_plane, right, down, place, next);
        const V f = place.plane_fraction;
        const V g = V(1.0) - f;
        for (int i = 0; i < quads; ++i) {
            const Quad<V>& here = result[i];
            result[i] = {g * here.a + f * next[i].a, g * here.b + f * next[i].b, g * here.c + f * next[i].c,
                         g * here.d + f * next[i].d};
        }
    }
}

#if SAMARA_PACKS_ONE_BODY
HWY_INLINE Spread first_of(const Quad<Spread>& quad) {
    return x_of(quad.numbers);
}
HWY_INLINE Spread second_of(const Quad<Spread>& quad) {
    return y_of(quad.numbers);
}
HWY_INLINE Packed first_three(const Quad<Spread>& quad) {
    return quad.numbers;
}

/// Finds the place for one body, both axes of the map side by side.
HWY_INLINE void find_place(const DirectionTable<double>& table, const Packed& direction,
                           Spread reynolds_number, Place<Spread>& place) {
    using Pair = Lanes<FourTag>;
    const Packed d = table.rotated ? broadcast<Spread>(table.to_map_axes) * direction : direction;
    const Packed magnitudes = hn::Abs(d.raw);
    const Spread norm = larger(sum_of(magnitudes), Spread(tiny<Spread>));
    const Pair there = ((Spread(1.0) / norm) * d).raw;
    const Pair zero(0.0);
    const Pair one(1.0);
    constexpr int swapped = 0b11'10'00'01;  // y, x
    const Pair others = one - magnitude(Pair(permuted<swapped>(there.raw)));
    const Pair folded = select(there < zero, -others, others);
    const auto below = z_of(d) < Spread(0.0);
    Pair fraction;
    const Pair cell = cell_of((select(below, folded, there) + one) * Pair(0.5 * (table.side - 1)),
                              Pair(table.side - 2.0), fraction);
    const Spread plane = plane_of(table, reynolds_number, place.plane_fraction);
    const Spread row = y_of(cell.raw);
    const Spread column = x_of(cell.raw);
    const Spread across = x_of(fraction.raw);
    const Spread down = y_of(fraction.raw);
    const Spread side(table.side);
    place.index = static_cast<std::int32_t>(
        hn::GetLane((((plane * side + row) * side + column) * Spread(table.width)).raw));
    place.weights[0] = (Spread(1.0) - down) * (Spread(1.0) - across);
    place.weights[1] = (Spread(1.0) - down) * across;
    place.weights[2] = down * (Spread(1.0) - across);
    place.weights[3] = down * across;
}

template <int quads>
HWY_INLINE void look_up(const DirectionTable<double>& table, const Place<Spread>& place,
                        Quad<Spread>* result) {
    const std::ptrdiff_t right = table.width;
    const std::ptrdiff_t down = right * table.side;
    const auto sum = [&](const double* n) HWY_ATTR {
        const FourTag four;
        return place.weights[0] * Packed(hn::Load(four, n)) +
               place.weights[1] * Packed(hn::Load(four, n + right)) +
               place.weights[2] * Packed(hn::Load(four, n + down)) +
               place.weights[3] * Packed(hn::Load(four, n + down + right));
    };
    const double* numbers = table.numbers() + place.index;
    for (int i = 0; i < quads; ++i) result[i].numbers = sum(numbers + 4 * i);
    if (table.planes() < 2) return;
    const Spread f = place.plane_fraction;
    const Spread g = Spread(1.0) - f;
    numbers += down * table.side;
    for (int i = 0; i < quads; ++i) {
        result[i].numbers = g * result[i].numbers + f * sum(numbers + 4 * i);
    }
}
#endif

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
