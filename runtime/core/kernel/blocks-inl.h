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

/// The lanes [first, first + N) of a block.
template <class Tag>
HWY_INLINE Simulation<Lanes<Tag>> load_simulation(Tag tag, const StateBlock& block, std::size_t first) {
    const auto field = [&](std::size_t i)
                           HWY_ATTR { return Lanes<Tag>(hn::Load(tag, block.numbers[i] + first)); };
    const auto triple = [&](std::size_t i) HWY_ATTR {
        return Triple<Lanes<Tag>>{field(i), field(i + 1), field(i + 2)};
    };
    return {triple(0),  {field(3), triple(4)},  triple(7), triple(10), triple(13), triple(16), triple(19),
            triple(22), {field(25), triple(26)}};
}
template <class Tag>
HWY_INLINE void store_flight(Tag tag, const Simulation<Lanes<Tag>>& simulation, StateBlock& block,
                             std::size_t first) {
    const auto keep = [&](std::size_t i, Lanes<Tag> value)
                          HWY_ATTR { hn::Store(value.raw, tag, block.numbers[i] + first); };
    const auto keep_triple = [&](std::size_t i, const Triple<Lanes<Tag>>& value) HWY_ATTR {
        keep(i, value.x);
        keep(i + 1, value.y);
        keep(i + 2, value.z);
    };
    keep_triple(0, simulation.position);
    keep(3, simulation.orientation.w);
    keep_triple(4, simulation.orientation.v);
    keep_triple(7, simulation.angular_velocity);
    keep_triple(10, simulation.velocity);
    keep_triple(13, simulation.seen_velocity);
    keep_triple(16, simulation.seen_rotation);
    keep_triple(19, simulation.angular_acceleration);
    keep_triple(22, simulation.acceleration);
    keep(25, simulation.wake.formed);
    keep_triple(26, simulation.wake.heading);
}

template <class Tag>
HWY_INLINE Simulation<Lanes<Tag>> select_flight(hn::Mask<Tag> condition, const Simulation<Lanes<Tag>>& a,
                                                const Simulation<Lanes<Tag>>& b) {
    return {select(condition, a.position, b.position),
            {select(condition, a.orientation.w, b.orientation.w),
             select(condition, a.orientation.v, b.orientation.v)},
            select(condition, a.angular_velocity, b.angular_velocity),
            select(condition, a.velocity, b.velocity),
            a.seen_velocity,
            a.seen_rotation,
            select(condition, a.angular_acceleration, b.angular_acceleration),
            select(condition, a.acceleration, b.acceleration),
            select(condition, a.wake, b.wake)};
}

/// What random numbers Noise::normals would give each lane.
template <class Tag>
struct LaneDraw {
    const StateBlock& block;
    std::size_t first;
    std::uint64_t step;

    [[nodiscard]] HWY_INLINE Triple<Lanes<Tag>> three() const {
        return three_normals(uniforms(NoiseStream::sampled_turbulence));
    }
    [[nodiscard]] HWY_INLINE SixNormals<Lanes<Tag>> six() const {
        const std::array<Lanes<Tag>, 4> rest = uniforms(NoiseStream::seen_rotation);
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

/// The bodies that may have touched the ground or an obstacle since before the substep, or may by the end of
/// the next: no fewer than touch_ground() would find.
template <class Tag>
HWY_INLINE hn::Mask<Tag> near_ground(const kernel::Contact& contact, const Simulation<Lanes<Tag>>& before,
                                     const Simulation<Lanes<Tag>>& simulation, Lanes<Tag> own_substep,
                                     Lanes<Tag> size) {
    using V = Lanes<Tag>;
    const V per_size = V(1.0) / size;
    const V substep = (size * size) * own_substep;
    const V turning =
        (per_size * per_size) * root(dot(simulation.angular_velocity, simulation.angular_velocity));
    const V speed = per_size * root(dot(simulation.velocity, simulation.velocity));
    const Triple<V> place = size * simulation.position;
    const Triple<V> place_before = size * before.position;
    const V margin = V(2.001) * substep * (speed + V(contact.ground_speed) + V(contact.radius) * turning);
    const auto near = place.z - V(contact.reach) < margin + V(1e-5 * contact.radius);
    if (!contact.has_obstacles) return near;
    // The velocity's change, by which touch_ground() looks farther, is that of both.
    const V speed_before = per_size * root(dot(before.velocity, before.velocity));
    const V around = margin + V(1.001) * (substep * (speed + speed_before + V(2.0 * contact.ground_speed)) +
                                          V(contact.radius));
    const auto in_reach = [&](V a, V b, double low, double high) HWY_ATTR {
        return hn::And(smaller(a, b) - around < V(high), V(low) < larger(a, b) + around);
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
        const double parts = static_cast<double>(substeps[lane - first]);
        if (substep >= parts) continue;
        BodyState state = state_of(block, lane);
        contact.resolve(contact.context, block.first_body + lane, time + (substep + 1) * (h / parts),
                        h / parts, state_of(before, lane), state);
        keep_state(state, block, lane);
    }
}

/// The Langevin update of one step. `draw` gives its random numbers; `size_square`: of the body's size.
template <class V, class Draw>
HWY_INLINE void sample_turbulence(const StepConstants& c, V h, const Draw& draw, V size_square,
                                  Simulation<V>& simulation) {
    if (c.turbulence == Turbulence::none) {
        simulation.seen_velocity = no_vector<V>();
        simulation.seen_rotation = no_vector<V>();
        return;
    }
    Level<V> level = turbulence_level(c, centroid_velocity(c, simulation));
    if (c.turbulence == Turbulence::constant) {
        level = {size_square * level.turbulent_kinetic_energy,
                 (size_square * size_square) * level.dissipation_rate};
    }
    if (c.langevin == Langevin::wake) {
        advance_wake(c, level, h, draw.three(), simulation);
    } else if (c.langevin == Langevin::sampled_turbulence) {
        advance_sampled_turbulence(c, level, h, draw.six(), simulation);
    } else {
        advance_body_velocity(c, level, h, draw.six(), simulation);
    }
}

/// Fluid at rest.
template <class V>
HWY_INLINE Stream<V> no_stream() {
    return {no_vector<V>(), no_vector<V>(), no_vector<V>(), false, no_vector<V>()};
}

/// Where the centroid is halfway through a step, as far as its velocity says (m, in the flow's frame).
template <class V>
HWY_INLINE Triple<V> halfway(const StepConstants& c, V h, const Simulation<V>& simulation) {
    const Square<V> to_world = rotation_matrix(simulation.orientation);
    const Triple<V> way = (V(0.5) * h * V(c.length)) * centroid_velocity(c, simulation);
    return simulation.position + to_world * (broadcast<V>(c.center_of_buoyancy) + way);
}

/// What a body sees between two steps: a stream that changes evenly; or a slip of its loads alone, which
/// stands for the step and does not push by its change.
template <class V>
HWY_INLINE Stream<V> seen_stream(const StepConstants& c, const Triple<V>& before,
                                 const Simulation<V>& simulation) {
    if (c.langevin != Langevin::wake) {
        return {before, simulation.seen_velocity, simulation.seen_rotation, false, no_vector<V>()};
    }
    const Triple<V> middle = V(0.5) * (before + simulation.seen_velocity);
    return {middle, middle, simulation.seen_rotation, true, middle};
}

/// The Langevin update of one step in a wind, or without (then `wind` is none), and the stream that the body
/// is in. What turbulence a body meets is a matter of its velocity in the wind.
template <class V, class Draw>
HWY_INLINE Stream<V> sample_fluid(const StepConstants& c, V h, bool windy, const Stream<V>& wind,
                                  const Draw& draw, V size_square, Simulation<V>& simulation) {
    const Triple<V> seen_before = simulation.seen_velocity;
    if (!windy) {
        sample_turbulence(c, h, draw, size_square, simulation);
        return seen_stream(c, seen_before, simulation);
    }
    const Triple<V> velocity = simulation.velocity;
    const Triple<V> of_wind = transposed_times(rotation_matrix(simulation.orientation), wind.begin);
    simulation.velocity = velocity - of_wind;
    sample_turbulence(c, h, draw, size_square, simulation);
    const bool driven = c.turbulence != Turbulence::none && c.langevin == Langevin::body_velocity;
    simulation.velocity = driven ? simulation.velocity + of_wind : velocity;
    if (!sees_turbulence(c)) return wind;
    const Stream<V> seen = seen_stream(c, seen_before, simulation);
    return {seen.begin + wind.begin, seen.end + wind.end, seen.rotation + wind.rotation, false,
            seen.wake_fluctuation};
}

/// The wind that the bodies of the lanes meet in a step.
template <class Tag>
HWY_INLINE Stream<Lanes<Tag>> met_wind(Tag tag, const StepConstants& c, const kernel::WindSource& source,
                                       std::uint64_t step, std::size_t bodies, Lanes<Tag> h, Lanes<Tag> size,
                                       const Simulation<Lanes<Tag>>& simulation) {
    using V = Lanes<Tag>;
    if (source.sample == nullptr) return no_stream<V>();
    HWY_ALIGN_MAX double row[hn::MaxLanes(Tag())];
    kernel::SampledWind sampled;
    const auto give = [&](V value, double* to) HWY_ATTR {
        hn::Store(value.raw, tag, row);
        for (std::size_t i = 0; i < bodies; ++i) to[i] = static_cast<double>(row[i]);
    };
    const auto take = [&](const double* from) HWY_ATTR {
        for (std::size_t i = 0; i < hn::Lanes(tag); ++i) row[i] = static_cast<double>(from[i]);
        return V(hn::Load(tag, row));
    };
    const Triple<V> place = size * halfway(c, h, simulation);
    give(place.x, sampled.place[0]);
    give(place.y, sampled.place[1]);
    give(place.z, sampled.place[2]);
    source.sample(source.context, step, bodies, sampled);
    const auto three = [&](const double(&rows)[3][kernel::SampledWind::size]) HWY_ATTR {
        return Triple<V>{take(rows[0]), take(rows[1]), take(rows[2])};
    };
    return {size * three(sampled.begin), size * three(sampled.end), (size * size) * three(sampled.rotation),
            false, no_vector<V>()};
}

/// What pushes the bodies of the lanes, in the units of a body of the shape's size that moves alike
/// (body_size.hpp).
template <class Tag>
HWY_INLINE Push<Lanes<Tag>> push_of(Tag tag, const kernel::ExternalLoads& external, std::size_t first,
                                    Lanes<Tag> size) {
    using V = Lanes<Tag>;
    HWY_ALIGN_MAX double row[hn::MaxLanes(Tag())];
    const auto take = [&](const double* from) HWY_ATTR {
        for (std::size_t i = 0; i < hn::Lanes(tag); ++i) row[i] = static_cast<double>(from[first + i]);
        return V(hn::Load(tag, row));
    };
    const auto three = [&](const double(&rows)[3][kernel::ExternalLoads::size]) HWY_ATTR {
        return Triple<V>{take(rows[0]), take(rows[1]), take(rows[2])};
    };
    return {(V(1.0) / size) * three(external.moment), three(external.force)};
}

/// Where bodies of the lanes [first, first + N) move: 1, and 0 in lanes without a body or with one that
/// rests or waits.
struct MovingLanes {
    MovingLanes(const kernel::Contact& contact, const StateBlock& block, std::uint64_t step,
                std::size_t first, std::size_t lanes) {
        if (contact.stay == nullptr && first + lanes <= block.bodies && step >= block.last_start) {
            std::fill_n(moves, lanes, 1.0);
            any_moves = true;
            return;
        }
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            const bool used = first + lane < block.bodies;
            const bool waits = used && step < block.first_step[first + lane];
            const bool rests =
                used && !waits && contact.stay != nullptr && lies_in_stillness(block, first + lane);
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

/// Leaves the bodies of the lanes that rest on the ground there for a step.
inline void stay_on_ground(const kernel::BlockSteps& task, std::uint64_t number, StateBlock& block,
                           std::size_t first, std::size_t lanes, const MovingLanes& lively) {
    const std::uint64_t step = task.first_step + number;
    for (std::size_t lane = first; lane < std::min<std::size_t>(first + lanes, block.bodies); ++lane) {
        if (lively.moves[lane - first] != 0.0 || step < block.first_step[lane]) continue;
        BodyState state = state_of(block, lane);
        task.contact.stay(task.contact.context, block.first_body + lane,
                          step_time(task.start, task.time_step, step),
                          step_time(task.start, task.time_step, step + 1), state);
        keep_state(state, block, lane);
    }
}

/// One step of the lanes [first, first + N) of a block; adds to the report.
template <class Tag>
HWY_INLINE void advance_lanes(Tag tag, const StepConstants& c, const kernel::BlockSteps& task,
                              std::uint64_t number, StateBlock& block, std::size_t first,
                              Simulation<Lanes<Tag>>& simulation, BatchReport& report) {
    using V = Lanes<Tag>;
    const std::size_t lanes = hn::Lanes(tag);
    const MovingLanes lively(task.contact, block, task.first_step + number, first, lanes);
    const auto let_others_stay = [&]() HWY_ATTR {
        if (!lively.any_rests || !task.contact.moves) return;
        store_flight(tag, simulation, block, first);
        stay_on_ground(task, number, block, first, lanes, lively);
        simulation = load_simulation(tag, block, first);
    };
    if (!lively.any_moves) return let_others_stay();

    const V size = task.sized ? V(hn::Load(tag, block.size_of + first)) : V(1.0);
    const V size_square = size * size;
    const V h = V(task.time_step) / size_square;
    const V moves(hn::Load(tag, lively.moves));
    const bool meets = task.contact.resolve != nullptr;
    // Of long copies those alone that are needed.
    StateBlock before;
    if (meets || lively.any_waits) store_flight(tag, simulation, before, first);
    const std::size_t used_lanes = std::min<std::size_t>(lanes, block.bodies - first);
    const bool windy = task.wind.sample != nullptr;
    const Stream<V> wind =
        met_wind(tag, c, task.wind, task.first_step + number, used_lanes, h, size, simulation);
    const Stream<V> sampled = sample_fluid(
        c, h, windy, wind, LaneDraw<Tag>{block, first, task.first_step + number}, size_square, simulation);
    if (lively.any_rests || lively.any_waits) {
        const auto stirred = V(0.5) < moves;
        const Simulation<V> previous = load_simulation(tag, before, first);
        simulation = select_flight<Tag>(stirred, simulation, previous);
        simulation.seen_velocity = select(stirred, simulation.seen_velocity, previous.seen_velocity);
        simulation.seen_rotation = select(stirred, simulation.seen_rotation, previous.seen_rotation);
    }

    HWY_ALIGN_MAX double parts[hn::MaxLanes(Tag())];
    const bool sees_fluid = windy || sees_turbulence(c);
    const V substeps = moves * substeps_of(c, h, sees_fluid, sampled.begin, simulation);
    hn::Store(substeps.raw, tag, parts);
    const bool all_whole = used_lanes == lanes && hn::AllTrue(tag, hn::Eq(substeps.raw, V(1.0).raw));
    int most = 1;
    if (all_whole) {
        report.implicit_steps += lanes;
    } else {
        most = 0;
        for (std::size_t lane = 0; lane < used_lanes; ++lane) {
            const int taken = static_cast<int>(parts[lane]);
            report.count(taken);
            most = std::max(most, taken);
        }
    }

    const V divisor = larger(V(1.0), substeps);
    const V substep = h / divisor;
    const Vector3d& pull = task.gravities[number];
    const Triple<V> gravity = (size_square * size) * Triple<V>{V(pull.x()), V(pull.y()), V(pull.z())};
    Push<V> push;
    const bool pushed = task.external != nullptr;
    if (pushed) push = push_of(tag, task.external[block.first_body / block.size], first, size);
    for (int i = 0; i < most; ++i) {
        StateBlock kept;
        if (!all_whole) store_flight(tag, simulation, kept, first);
        implicit_step(c, gravity, substep, sees_fluid, all_whole ? sampled : part_of(sampled, i, divisor),
                      pushed ? &push : nullptr, simulation);
        if (!all_whole)
            simulation = select_flight<Tag>(V(i) < substeps, simulation, load_simulation(tag, kept, first));
        if (!meets) continue;
        const Simulation<V> previous = load_simulation(tag, before, first);
        if (!hn::AllFalse(tag, near_ground(task.contact, previous, simulation, substep, size))) {
            std::copy_n(block.at_rest + first, lanes, before.at_rest + first);
            store_flight(tag, simulation, block, first);
            const double begin = step_time(task.start, task.time_step, task.first_step + number);
            touch_ground(task.contact, before, block, first, lanes, i, parts, begin, task.time_step);
            simulation = load_simulation(tag, block, first);
        }
        store_flight(tag, simulation, before, first);
    }
    let_others_stay();
}

inline BatchReport advance_all(const StepConstants& c, const kernel::BlockSteps& task, StateBlock* blocks,
                               std::size_t count) {
    const hn::CappedTag<double, StateBlock::size> tag;
    BatchReport report;
    for (StateBlock* block = blocks; block != blocks + count; ++block) {
        for (std::size_t first = 0; first < block->bodies; first += hn::Lanes(tag)) {
            auto simulation = load_simulation(tag, *block, first);
            for (std::uint64_t number = 0; number < task.steps; ++number) {
                advance_lanes(tag, c, task, number, *block, first, simulation, report);
            }
            store_flight(tag, simulation, *block, first);
        }
    }
    return report;
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
