// Blocks of bodies over many steps.
// Included once for each instruction set (Highway), hence no plain include guard.
#if defined(SAMARA_BLOCKS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SAMARA_BLOCKS_INL_H
#undef SAMARA_BLOCKS_INL_H
#else
#define SAMARA_BLOCKS_INL_H
#endif

#include <algorithm>

#include "samara/core/kernel/kernel.hpp"
#include "samara/core/kernel/langevin-inl.h"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

/// Loads the lanes [first, first + N) of a block, in single precision rounded but for the position.
template <class Tag>
HWY_INLINE StepState<Lanes<Tag>> load_step_state(Tag tag, const StateBlock& block, std::size_t first) {
    const auto row = [&](std::size_t i) HWY_ATTR { return load_row(tag, block.numbers[i] + first); };
    const auto field = [&](std::size_t i) HWY_ATTR { return rounded(row(i)); };
    const auto triple = [&](std::size_t i) HWY_ATTR {
        return Triple<Lanes<Tag>>{field(i), field(i + 1), field(i + 2)};
    };
    return {{row(0), row(1), row(2)},
            {field(3), triple(4)},
            triple(7),
            triple(10),
            triple(13),
            triple(16),
            triple(19),
            triple(22),
            {field(25), triple(26)}};
}
template <class Tag>
HWY_INLINE void store_step_state(Tag /*tag*/, const StepState<Lanes<Tag>>& step_state, StateBlock& block,
                                 std::size_t first) {
    const auto keep = [&](std::size_t i, PositionOf<Lanes<Tag>> value)
                          HWY_ATTR { store_row(value, block.numbers[i] + first); };
    const auto keep_triple = [&](std::size_t i, const auto& value) HWY_ATTR {
        keep(i, value.x);
        keep(i + 1, value.y);
        keep(i + 2, value.z);
    };
    keep_triple(0, step_state.position);
    keep(3, step_state.orientation.w);
    keep_triple(4, step_state.orientation.v);
    keep_triple(7, step_state.angular_velocity);
    keep_triple(10, step_state.velocity);
    keep_triple(13, step_state.sampled_velocity);
    keep_triple(16, step_state.sampled_rotation);
    keep_triple(19, step_state.angular_acceleration);
    keep_triple(22, step_state.acceleration);
    keep(25, step_state.wake.formed);
    keep_triple(26, step_state.wake.heading);
}

template <class Tag>
HWY_INLINE StepState<Lanes<Tag>> select_step_state(hn::Mask<Tag> condition, const StepState<Lanes<Tag>>& a,
                                                   const StepState<Lanes<Tag>>& b) {
    return {select(condition, a.position, b.position),
            {select(condition, a.orientation.w, b.orientation.w),
             select(condition, a.orientation.v, b.orientation.v)},
            select(condition, a.angular_velocity, b.angular_velocity),
            select(condition, a.velocity, b.velocity),
            a.sampled_velocity,
            a.sampled_rotation,
            select(condition, a.angular_acceleration, b.angular_acceleration),
            select(condition, a.acceleration, b.acceleration),
            select(condition, a.wake, b.wake)};
}

/// Returns the random numbers that Noise::normals() gives each lane.
template <class Tag>
struct LaneDraw {
    const StateBlock& block;
    std::size_t first;
    std::uint64_t step;

    [[nodiscard]] HWY_INLINE Triple<Lanes<Tag>> three() const {
        return three_normals(uniforms(NoiseStream::sampled_turbulence));
    }
    [[nodiscard]] HWY_INLINE SixNormals<Lanes<Tag>> six() const {
        const std::array<Lanes<Tag>, 4> rest = uniforms(NoiseStream::sampled_rotation);
        return six_normals(uniforms(NoiseStream::sampled_turbulence), rest[0], rest[1]);
    }

  private:
    [[nodiscard]] HWY_INLINE std::array<Lanes<Tag>, 4> uniforms(NoiseStream stream) const {
        const Tag tag;
        const hn::Rebind<std::uint32_t, Tag> words;
        const auto low = hn::Set(words, static_cast<std::uint32_t>(step));
        const auto high = hn::Set(
            words, static_cast<std::uint32_t>(step >> 32U) | (static_cast<std::uint32_t>(stream) << 16U));
        const auto word = [&](int i) HWY_ATTR { return hn::Load(words, block.noise[i] + first); };
        const auto bits = philox(words, {low, high, word(2), word(3)}, word(0), word(1));
        return {unit_interval(tag, bits[0]), unit_interval(tag, bits[1]), unit_interval(tag, bits[2]),
                unit_interval(tag, bits[3])};
    }
};

/// Returns the bodies that may have touched the ground or an obstacle since before the substep, or may by the
/// end of the next: no fewer than touch_ground() would find.
template <class Tag>
HWY_INLINE hn::Mask<Tag> near_ground(const kernel::Contact& contact, const StepState<Lanes<Tag>>& before,
                                     const StepState<Lanes<Tag>>& step_state, Lanes<Tag> own_substep,
                                     Lanes<Tag> size) {
    using V = Lanes<Tag>;
    const V per_size = V(1.0) / size;
    const V substep = (size * size) * own_substep;
    const V rotation_rate =
        (per_size * per_size) * root(dot(step_state.angular_velocity, step_state.angular_velocity));
    const V speed = per_size * root(dot(step_state.velocity, step_state.velocity));
    // Places are compared in double precision: single would not tell them apart far from the origin.
    using P = PositionOf<V>;
    const Triple<P> place = P(size) * step_state.position;
    const Triple<P> place_before = P(size) * before.position;
    const V margin =
        V(2.001) * substep * (speed + V(contact.ground_speed) + V(contact.radius) * rotation_rate);
    const auto near = rounded(place.z - P(contact.reach)) < margin + V(1e-5 * contact.radius);
    if (!contact.has_obstacles) return near;
    // touch_ground() looks farther by the change of velocity: here by both speeds.
    const V speed_before = per_size * root(dot(before.velocity, before.velocity));
    const V around = margin + V(1.001) * (substep * (speed + speed_before + V(2.0 * contact.ground_speed)) +
                                          V(contact.radius));
    const auto in_reach = [&](P a, P b, double low, double high) HWY_ATTR {
        return hn::And(rounded(smaller(a, b) - P(high)) < around, rounded(P(low) - larger(a, b)) < around);
    };
    const auto by_obstacle =
        hn::And(in_reach(place_before.x, place.x, contact.box_low.x(), contact.box_high.x()),
                hn::And(in_reach(place_before.y, place.y, contact.box_low.y(), contact.box_high.y()),
                        in_reach(place_before.z, place.z, contact.box_low.z(), contact.box_high.z())));
    return hn::Or(near, by_obstacle);
}

/// Lets the bodies of the lanes touch the ground. `before`: the block before the substep.
inline void touch_ground(const kernel::Contact& contact, const StateBlock& before, StateBlock& block,
                         std::size_t first, std::size_t lanes, int substep, const double* substeps,
                         double time, double h) {
    for (std::size_t lane = first; lane < std::min<std::size_t>(first + lanes, block.bodies); ++lane) {
        const double counts = static_cast<double>(substeps[lane - first]);
        if (substep >= counts) continue;
        BodyState state = state_of(block, lane);
        contact.resolve(contact.context, block.first_body + lane, time + (substep + 1) * (h / counts),
                        h / counts, state_of(before, lane), state);
        keep_state(state, block, lane);
    }
}

/// Does the Langevin update of one step. `draw` gives its random numbers; `size_square`: of the body's size.
template <class V, class Draw>
HWY_INLINE void sample_turbulence(const ConstantsOf<V>& c, V h, const Draw& draw, V size_square,
                                  StepState<V>& step_state) {
    if (c.turbulence == Turbulence::none) {
        step_state.sampled_velocity = no_vector<V>();
        step_state.sampled_rotation = no_vector<V>();
        return;
    }
    Level<V> level = turbulence_level(c, centroid_velocity(c, step_state));
    if (c.turbulence == Turbulence::constant) {
        level = {size_square * level.turbulent_kinetic_energy,
                 (size_square * size_square) * level.dissipation_rate};
    }
    if (c.langevin == Langevin::wake) {
        advance_wake(c, level, h, draw.three(), step_state);
    } else if (c.langevin == Langevin::sampled_turbulence) {
        advance_sampled_turbulence(c, level, h, draw.six(), step_state);
    } else {
        advance_body_velocity(c, level, h, draw.six(), step_state);
    }
}

/// Returns a stream at rest.
template <class V>
HWY_INLINE Stream<V> no_stream() {
    return {no_vector<V>(), no_vector<V>(), no_vector<V>(), false, no_vector<V>()};
}

/// Returns the place of the centroid at mid-step by its velocity (m, in the flow's frame).
template <class V>
HWY_INLINE Triple<PositionOf<V>> halfway(const ConstantsOf<V>& c, V h, const StepState<V>& step_state) {
    const Square<V> to_world = rotation_matrix(step_state.orientation);
    const Triple<V> offset = (V(0.5) * h * V(c.length)) * centroid_velocity(c, step_state);
    return moved(step_state.position, to_world * (broadcast<V>(c.center_of_buoyancy) + offset));
}

/// Returns the stream of a body in a step: one that changes evenly; or a fluctuation that affects its loads
/// alone, which is constant in the step and does not accelerate the fluid.
template <class V>
HWY_INLINE Stream<V> sampled_stream(const ConstantsOf<V>& c, const Triple<V>& before,
                                    const StepState<V>& step_state) {
    if (c.langevin != Langevin::wake) {
        return {before, step_state.sampled_velocity, step_state.sampled_rotation, false, no_vector<V>()};
    }
    const Triple<V> middle = V(0.5) * (before + step_state.sampled_velocity);
    return {middle, middle, step_state.sampled_rotation, true, middle};
}

/// Does the Langevin update of one step, in a wind or without (then `wind` is none), and returns the stream
/// that the body is in. The turbulence depends on the body's velocity relative to the wind.
template <class V, class Draw>
HWY_INLINE Stream<V> sample_fluid(const ConstantsOf<V>& c, V h, bool windy, const Stream<V>& wind,
                                  const Draw& draw, V size_square, StepState<V>& step_state) {
    const Triple<V> seen_before = step_state.sampled_velocity;
    if (!windy) {
        sample_turbulence(c, h, draw, size_square, step_state);
        return sampled_stream(c, seen_before, step_state);
    }
    const Triple<V> velocity = step_state.velocity;
    const Triple<V> of_wind = transposed_times(rotation_matrix(step_state.orientation), wind.begin);
    step_state.velocity = velocity - of_wind;
    sample_turbulence(c, h, draw, size_square, step_state);
    const bool driven = c.turbulence != Turbulence::none && c.langevin == Langevin::body_velocity;
    step_state.velocity = driven ? step_state.velocity + of_wind : velocity;
    if (!sees_turbulence(c)) return wind;
    const Stream<V> seen = sampled_stream(c, seen_before, step_state);
    return {seen.begin + wind.begin, seen.end + wind.end, seen.rotation + wind.rotation, false,
            seen.wake_fluctuation};
}

/// Samples the wind for the bodies of the lanes in a step.
template <class Tag>
HWY_INLINE Stream<Lanes<Tag>> sampled_wind(Tag tag, const ConstantsOf<Lanes<Tag>>& c,
                                           const kernel::WindSource& source, std::uint64_t step,
                                           std::size_t bodies, Lanes<Tag> h, Lanes<Tag> size,
                                           const StepState<Lanes<Tag>>& step_state) {
    using V = Lanes<Tag>;
    if (source.sample == nullptr) return no_stream<V>();
    kernel::SampledWind sampled;
    const Triple<PositionOf<V>> place = PositionOf<V>(size) * halfway(c, h, step_state);
    store_row(place.x, sampled.place[0]);
    store_row(place.y, sampled.place[1]);
    store_row(place.z, sampled.place[2]);
    source.sample(source.context, step, bodies, sampled);
    const auto three = [&](const double(&rows)[3][kernel::SampledWind::size]) HWY_ATTR {
        return Triple<V>{rounded(load_row(tag, rows[0])), rounded(load_row(tag, rows[1])),
                         rounded(load_row(tag, rows[2]))};
    };
    return {size * three(sampled.begin), size * three(sampled.end), (size * size) * three(sampled.rotation),
            false, no_vector<V>()};
}

/// Returns the external loads on the bodies of the lanes, in the units of a body of the shape's size in
/// similar motion (body_size.hpp).
template <class Tag>
HWY_INLINE Push<Lanes<Tag>> push_of(Tag tag, const kernel::ExternalLoads& external, std::size_t first,
                                    Lanes<Tag> size) {
    using V = Lanes<Tag>;
    const auto three = [&](const double(&rows)[3][kernel::ExternalLoads::size]) HWY_ATTR {
        return Triple<V>{rounded(load_row(tag, rows[0] + first)), rounded(load_row(tag, rows[1] + first)),
                         rounded(load_row(tag, rows[2] + first))};
    };
    return {(V(1.0) / size) * three(external.moment), three(external.force)};
}

/// Marks the lanes [first, first + N) whose bodies move: 1, and 0 in lanes without a body or with one that
/// rests or waits.
struct MovingLanes {
    MovingLanes(const kernel::Contact& contact, const StateBlock& block, std::uint64_t step,
                std::size_t first, std::size_t lanes) {
        if (contact.resolve == nullptr && first + lanes <= block.bodies && step >= block.last_start) {
            std::fill_n(moves, lanes, 1.0);
            any_moves = true;
            return;
        }
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const bool used = first + lane < block.bodies;
            const bool waits = used && step < block.first_step[first + lane];
            const bool rests = used && !waits && contact.resolve != nullptr &&
                               block.at_rest[first + lane] != 0 &&
                               contact.judgement.skips(step, is_still(block, first + lane));
            moves[lane] = used && !rests && !waits ? 1.0 : 0.0;
            any_moves = any_moves || moves[lane] != 0.0;
            any_rests = any_rests || rests;
            any_waits = any_waits || waits;
        }
    }
    HWY_ALIGN_MAX double moves[StateBlock::size];
    bool any_moves = false;
    bool any_rests = false;
    bool any_waits = false;
};

/// Keeps the bodies of the lanes that rest on the ground there for a step.
inline void keep_on_ground(const kernel::BlockSteps& task, std::uint64_t number, StateBlock& block,
                           std::size_t first, std::size_t lanes, const MovingLanes& moving_lanes) {
    const std::uint64_t step = task.first_step + number;
    for (std::size_t lane = first; lane < std::min<std::size_t>(first + lanes, block.bodies); ++lane) {
        if (moving_lanes.moves[lane - first] != 0.0 || step < block.first_step[lane]) continue;
        BodyState state = state_of(block, lane);
        task.contact.stay(task.contact.context, block.first_body + lane,
                          step_time(task.start, task.time_step, step),
                          step_time(task.start, task.time_step, step + 1), state);
        keep_state(state, block, lane);
    }
}

/// Takes one step of the lanes [first, first + N) of a block; adds to the report.
template <class Tag>
HWY_INLINE void advance_lanes(Tag tag, const ConstantsOf<Lanes<Tag>>& c, const kernel::BlockSteps& task,
                              std::uint64_t number, StateBlock& block, std::size_t first,
                              StepState<Lanes<Tag>>& step_state, BatchReport& report) {
    using V = Lanes<Tag>;
    const std::size_t lanes = hn::Lanes(tag);
    const MovingLanes moving_lanes(task.contact, block, task.first_step + number, first, lanes);
    const auto keep_others_on_ground = [&]() HWY_ATTR {
        if (!moving_lanes.any_rests || !task.contact.moves) return;
        store_step_state(tag, step_state, block, first);
        keep_on_ground(task, number, block, first, lanes, moving_lanes);
        step_state = load_step_state(tag, block, first);
    };
    if (!moving_lanes.any_moves) return keep_others_on_ground();

    const V size = task.sized ? rounded(load_row(tag, block.size_of + first)) : V(1.0);
    const V size_square = size * size;
    const V own_excess = c.keeps_thickness ? V(1.0) / size - V(1.0) : V(0.0);
    const V h = V(task.time_step) / size_square;
    const V moves = rounded(load_row(tag, moving_lanes.moves));
    const bool has_contact = task.contact.resolve != nullptr;
    StepState<V> before = step_state;
    const std::size_t used_lanes = std::min<std::size_t>(lanes, block.bodies - first);
    const bool windy = task.wind.sample != nullptr;
    const Stream<V> wind =
        sampled_wind(tag, c, task.wind, task.first_step + number, used_lanes, h, size, step_state);
    const Stream<V> sampled = sample_fluid(
        c, h, windy, wind, LaneDraw<Tag>{block, first, task.first_step + number}, size_square, step_state);
    if (moving_lanes.any_rests || moving_lanes.any_waits) {
        const auto is_moving = V(0.5) < moves;
        step_state = select_step_state<Tag>(is_moving, step_state, before);
        step_state.sampled_velocity = select(is_moving, step_state.sampled_velocity, before.sampled_velocity);
        step_state.sampled_rotation = select(is_moving, step_state.sampled_rotation, before.sampled_rotation);
    }

    HWY_ALIGN_MAX double counts[hn::MaxLanes(Tag())];
    const bool sees_fluid = windy || sees_turbulence(c);
    const V substeps = moves * substeps_of(c, h, sees_fluid, sampled.begin, step_state);
    store_row(PositionOf<V>(substeps), counts);
    const bool all_whole = used_lanes == lanes && hn::AllTrue(tag, hn::Eq(substeps.raw, V(1.0).raw));
    int most = 1;
    if (all_whole) {
        report.implicit_steps += lanes;
    } else {
        most = 0;
        for (std::size_t lane = 0; lane < used_lanes; ++lane) {
            const int taken = static_cast<int>(counts[lane]);
            report.count(taken);
            most = std::max(most, taken);
        }
    }

    const V divisor = larger(V(1.0), substeps);
    const V substep = h / divisor;
    const Vector3d& pull = task.gravities[number];
    // None where nothing moves: there it would call for second passes.
    const Triple<V> gravity = (moves * size_square * size) * Triple<V>{V(pull.x()), V(pull.y()), V(pull.z())};
    Push<V> push;
    const bool pushed = task.external != nullptr;
    if (pushed) push = push_of(tag, task.external[block.first_body / block.size], first, size);
    for (int i = 0; i < most; ++i) {
        const StepState<V> kept = step_state;
        implicit_step(c, gravity, substep, sees_fluid, all_whole ? sampled : part_of(sampled, i, divisor),
                      pushed ? &push : nullptr, own_excess, step_state);
        if (!all_whole) step_state = select_step_state<Tag>(V(i) < substeps, step_state, kept);
        if (!has_contact) continue;
        if (!hn::AllFalse(tag, near_ground(task.contact, before, step_state, substep, size))) {
            StateBlock block_before;
            std::copy_n(block.at_rest + first, lanes, block_before.at_rest + first);
            store_step_state(tag, before, block_before, first);
            store_step_state(tag, step_state, block, first);
            const double begin = step_time(task.start, task.time_step, task.first_step + number);
            touch_ground(task.contact, block_before, block, first, lanes, i, counts, begin, task.time_step);
            step_state = load_step_state(tag, block, first);
        }
        before = step_state;
    }
    keep_others_on_ground();
}

template <class Real>
BatchReport advance_all(const StepConstantsIn<Real>& c, const kernel::BlockSteps& task, StateBlock* blocks,
                        std::size_t count) {
    const hn::CappedTag<Real, StateBlock::size> tag;
    BatchReport report;
    for (StateBlock* block = blocks; block != blocks + count; ++block) {
        for (std::size_t first = 0; first < block->bodies; first += hn::Lanes(tag)) {
            auto step_state = load_step_state(tag, *block, first);
            for (std::uint64_t number = 0; number < task.steps; ++number) {
                advance_lanes(tag, c, task, number, *block, first, step_state, report);
            }
            store_step_state(tag, step_state, *block, first);
        }
    }
    return report;
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
