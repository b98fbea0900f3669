// One implicit step (docs/theory, "The step").
// Included once for each instruction set (Highway), hence no plain include guard.
#if defined(SAMARA_STEP_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SAMARA_STEP_INL_H
#undef SAMARA_STEP_INL_H
#else
#define SAMARA_STEP_INL_H
#endif

#include "samara/core/kernel/body_state.hpp"
#include "samara/core/kernel/loads-inl.h"

HWY_BEFORE_NAMESPACE();
namespace samara::HWY_NAMESPACE {

/// BodyState (step.hpp) in the step's numbers.
template <class V>
struct Simulation {
    Triple<V> position;
    Turn<V> orientation;
    Triple<V> angular_velocity, velocity;
    Triple<V> seen_velocity, seen_rotation;
    Triple<V> angular_acceleration, acceleration;
    WakeState<V> wake;
};

/// The velocity (or acceleration) of the centroid from that of the centre of mass: l is taken out of it.
template <class V>
HWY_INLINE Triple<V> to_centroid(const StepConstants& c, const Triple<V>& turning,
                                 const Triple<V>& velocity) {
    if (!c.off_center) return V(c.inverse_length) * velocity;
    return V(c.inverse_length) * (velocity + cross(turning, broadcast<V>(c.center_of_buoyancy)));
}
/// The reverse of to_centroid.
template <class V>
HWY_INLINE Triple<V> from_centroid(const StepConstants& c, const Triple<V>& turning,
                                   const Triple<V>& velocity) {
    if (!c.off_center) return V(c.length) * velocity;
    return V(c.length) * velocity - cross(turning, broadcast<V>(c.center_of_buoyancy));
}

/// The velocity of the centroid, in l a second.
template <class V>
HWY_INLINE Triple<V> centroid_velocity(const StepConstants& c, const Simulation<V>& simulation) {
    return to_centroid(c, simulation.angular_velocity, simulation.velocity);
}

template <class V>
struct Velocities {
    Triple<V> omega, velocity;
};

/// The sampled turbulence's velocity (m/s, world axes) when a step begins and when it ends: between them it
/// changes evenly. Its rotation (rad/s) is held. Where it is a slip of the loads alone it does neither.
template <class V>
struct Stream {
    Triple<V> begin, end, rotation;
    bool on_loads_alone = false;
    Triple<V> wake_fluctuation;  ///< of the wake, in it
};

/// The stream of the part `i` of a step that is cut into `parts`, from that of the whole step.
template <class V>
HWY_INLINE Stream<V> part_of(const Stream<V>& whole, int i, V parts) {
    if (whole.on_loads_alone) return whole;
    const Triple<V> difference = whole.end - whole.begin;
    const Triple<V> begin = i == 0 ? whole.begin : whole.begin + (V(i) / parts) * difference;
    const Triple<V> end = whole.begin + (V(i + 1) / parts) * difference;
    return {begin, select(V(i + 1) < parts, end, whole.end), whole.rotation, false, whole.wake_fluctuation};
}

/// A host's push: moment about the centre of mass and force (world axes, in the shape's own units).
template <class V>
struct Push {
    Triple<V> moment, force;
};

/// What the passes over one step share: its start. Velocities are those relative to the sampled turbulence.
template <class V>
struct StepStart {
    V h;
    Triple<V> omega, velocity;
    Triple<V> gravity, seen_rotation, wake_fluctuation;  // body axes
    WakeState<V> wake;                                   // when the step begins
    bool fluid_turns;
    bool is_pushed;
    Push<V> push;  // body axes, about the centroid
    /// Whether the body turns by more than a radian: its system is then solved once more for what rounding
    /// left, since the elimination does not look for the best pivots.
    typename NumberTraits<V>::Mask wild;
};

/// The velocities inside the step, how they differ from the start's, and the turn they were found with.
template <class V>
struct StepMiddle {
    Triple<V> omega, velocity;
    Velocities<V> change;
    Triple<V> half_turn;
    V theta;
    V stiffness;  // of the moving
};

/// What a step may be off by, over the body's speed, where its middle is found in one pass; and how stiff its
/// drag may be there (at 1 the one pass would hardly settle at the terminal speed, with h D / K above it
/// not).
inline constexpr double one_pass_tolerance = 3e-5;
inline constexpr double one_pass_stiffness = 0.5;

/// How stiff the drag is: h max(D_ii / K_ii) of the turning and of the moving.
template <class V>
struct Stiffness {
    V turning, moving;
};
template <class V>
HWY_INLINE Stiffness<V> stiffness(const StepConstants& c, const LoadBlocks<V>& loads, V h) {
    const auto of_block = [h](const Square<V>& block, const Triple<double>& inverse_inertia) HWY_ATTR {
        return h * largest_of(product_of_each(diagonal_of(block), broadcast<V>(inverse_inertia)));
    };
    return {of_block(loads.moment_by_rotation, c.inverse_angular),
            of_block(loads.force_by_velocity, c.inverse_linear)};
}

/// The step's matrix by its blocks, ready to solve with.
template <class V>
struct StepMatrix {
    Square<V> turning, coupling, back, moving;
    Square<V> linear_inverse, linear_by_angular, angular_inverse;

    /// Eliminates the velocity, and then what is left for the turning.
    HWY_INLINE void factorise() {
        linear_inverse = inverse(moving);
        linear_by_angular = linear_inverse * back;
        angular_inverse = inverse(turning - coupling * linear_by_angular);
    }
    [[nodiscard]] HWY_INLINE Velocities<V> solved_for(const Triple<V>& moment, const Triple<V>& force) const {
        const Triple<V> rest = linear_inverse * force;
        const Triple<V> omega = angular_inverse * (moment - coupling * rest);
        return {omega, rest - linear_by_angular * omega};
    }
};

/// What stands still against the world while the body turns under it by half a step.
template <class V>
struct HalfTurn {
    Triple<V> half_turn;
    HWY_INLINE Triple<V> operator()(const Triple<V>& a) const { return turned_back(half_turn, a); }
};

/// Solves the step's system with the loads and the transport taken at the middle that was found or guessed
/// before. Its unknowns are the velocities' changes: solving for the velocities themselves would drift by a
/// rounding error a step.
template <class V>
HWY_INLINE void improve(const StepConstants& c, const StepStart<V>& start, StepMiddle<V>& middle) {
    middle.half_turn = (V(0.5) * start.h) * middle.omega;
    const HalfTurn<V> under_body{middle.half_turn};
    const Triple<V> gravity = under_body(start.gravity);
    // Of the linear momentum the part along the velocity (m* v, of which the unit is m*) acts as a force
    // alone: as p x v its moment would vanish only where the v inside p and the one it acts on are parallel,
    // and else spin even a sphere.
    StepMatrix<V> matrix;
    matrix.turning = broadcast_symmetric<V>(c.inertia_angular);
    const Square<V> directed_inertia = broadcast_symmetric<V>(c.directed_inertia);
    matrix.moving = plus_diagonal(directed_inertia, V(1.0));
    Triple<V> angular_momentum = matrix.turning * middle.omega;
    Triple<V> momentum = directed_inertia * middle.velocity;
    if (c.coupled) {
        matrix.coupling = broadcast<V>(c.inertia_coupling);
        matrix.back = transposed(matrix.coupling);
        angular_momentum = angular_momentum + matrix.coupling * middle.velocity;
        momentum = momentum + matrix.back * middle.omega;
    } else {
        matrix.coupling = no_matrix<V>();
        matrix.back = matrix.coupling;
    }
    Triple<V> moment = cross(angular_momentum, start.omega) + cross(momentum, start.velocity);
    Triple<V> force =
        V(c.weight) * gravity + cross(momentum, start.omega) - cross(middle.omega, start.velocity);
    if (c.off_center) moment = moment + cross(broadcast<V>(c.weight_moment), gravity);
    if (start.is_pushed) {
        moment = moment + under_body(start.push.moment);
        force = force + under_body(start.push.force);
    }
    V step = V(0.5) * start.h;
    middle.theta = V(0.5);
    if (c.loads != Loads::none) {
        Shares<V> shares{V(1.0), V(1.0)};
        if (c.wake_forms) {
            shares = shares_of(
                wake_in_the_middle(c, start.wake, start.h, middle.omega, middle.velocity, middle.half_turn));
        }
        LoadBlocks<V> loads;
        if (start.fluid_turns) {
            const Triple<V> fluid_rotation = under_body(start.seen_rotation);
            loads = relative_load_blocks(c, middle.omega - fluid_rotation, middle.velocity, middle.omega,
                                         shares.moment);
            moment = moment + loads.moment_by_rotation * fluid_rotation;
            force = force + loads.force_by_rotation * fluid_rotation;
        } else {
            loads = relative_load_blocks(c, middle.omega, middle.velocity, middle.omega, shares.moment);
        }
        add_transport(c, middle.omega, middle.velocity, shares.transport, loads);
        if (c.has_side_pressure)
            add_side_pressure(c, middle.velocity, under_body(start.wake_fluctuation), loads);
        const Stiffness<V> stiff = stiffness(c, loads, start.h);
        const V z = larger(stiff.turning, stiff.moving);
        middle.theta = (V(3.0) + z) / (V(6.0) + z);
        middle.stiffness = stiff.moving;
        step = middle.theta * start.h;
        matrix.turning = matrix.turning + step * loads.moment_by_rotation;
        matrix.coupling = matrix.coupling + step * loads.moment_by_velocity;
        matrix.back = matrix.back + step * loads.force_by_rotation;
        matrix.moving = matrix.moving + step * loads.force_by_velocity;
        moment =
            moment - (loads.moment_by_rotation * start.omega + loads.moment_by_velocity * start.velocity);
        force = force - (loads.force_by_rotation * start.omega + loads.force_by_velocity * start.velocity);
    }
    matrix.turning = plus_cross(matrix.turning, -step * angular_momentum);
    matrix.coupling = plus_cross(matrix.coupling, -step * momentum);
    matrix.back = plus_cross(matrix.back, -step * momentum);
    matrix.moving = plus_cross(matrix.moving, step * middle.omega);
    matrix.factorise();

    const Triple<V> right_moment = step * moment;
    const Triple<V> right_force = step * force;
    Velocities<V> change = matrix.solved_for(right_moment, right_force);
    if (NumberTraits<V>::any_of(start.wild)) {
        const Velocities<V> more = matrix.solved_for(
            right_moment - matrix.turning * change.omega - matrix.coupling * change.velocity,
            right_force - matrix.back * change.omega - matrix.moving * change.velocity);
        change.omega = select(start.wild, change.omega + more.omega, change.omega);
        change.velocity = select(start.wild, change.velocity + more.velocity, change.velocity);
    }
    middle.change = change;
    middle.omega = start.omega + change.omega;
    middle.velocity = start.velocity + change.velocity;
}

template <class Condition, class V>
HWY_INLINE StepMiddle<V> select(Condition condition, const StepMiddle<V>& a, const StepMiddle<V>& b) {
    return {select(condition, a.omega, b.omega),
            select(condition, a.velocity, b.velocity),
            {select(condition, a.change.omega, b.change.omega),
             select(condition, a.change.velocity, b.change.velocity)},
            select(condition, a.half_turn, b.half_turn),
            select(condition, a.theta, b.theta),
            select(condition, a.stiffness, b.stiffness)};
}

/// Whether a guessed middle is to be improved twice: always where a body meets no noise. Noise alone, which
/// is not smooth, is off by more in a step than what the second pass would mend. Loads and transport go with
/// the square of the velocity: to the first order, one made from a guess that was off by d is off by 2 d / u
/// of the velocity's change. One pass is of second order too, where drag is not stiff.
template <class V>
HWY_INLINE typename NumberTraits<V>::Mask is_unsure(const StepConstants& c, const StepStart<V>& start,
                                                    const Velocities<V>& guess, const StepMiddle<V>& found) {
    const V tip_square(c.tip_square);
    const auto square = [&](const Triple<V>& omega, const Triple<V>& velocity)
                            HWY_ATTR { return dot(velocity, velocity) + tip_square * dot(omega, omega); };
    const V off = square(found.omega - guess.omega, found.velocity - guess.velocity);
    const V change = square(found.change.omega, found.change.velocity);
    const V speed = square(found.omega, found.velocity);
    const bool is_noisy = c.turbulence != Turbulence::none;
    const V allowed(is_noisy ? one_pass_tolerance * one_pass_tolerance / 16.0 : -1.0);
    const auto far_off = allowed * (speed * speed) < off * change;
    return either(either(far_off, V(one_pass_stiffness) < found.stiffness), start.wild);
}

/// The middle that a second pass finds, for those where it matters. Not inlined: most steps need none.
template <class V>
HWY_NOINLINE void find_again(const StepConstants& c, const StepStart<V>& start, const Velocities<V>& guess,
                             typename NumberTraits<V>::Mask unsure, StepMiddle<V>& middle) {
    StepMiddle<V> found = middle;
    // Where drag is stiff, one made from the speed alone would swing about the terminal speed: halfway to the
    // guess lies Newton's root. Where it is not, the middle stays, of second order.
    const V square = middle.stiffness * middle.stiffness;
    const V back = V(0.5) * square / (V(36.0) + square);
    found.velocity = middle.velocity + back * (guess.velocity - middle.velocity);
    improve(c, start, found);
    middle = select(unsure, found, middle);
}

/// The middle of the step from velocities guessed there: by one pass, or where that says it matters by two.
template <class V>
HWY_INLINE StepMiddle<V> found_middle(const StepConstants& c, const StepStart<V>& start,
                                      const Velocities<V>& guess) {
    StepMiddle<V> found;
    found.omega = guess.omega;
    found.velocity = guess.velocity;
    found.stiffness = V(0.0);
    improve(c, start, found);
    const auto unsure = is_unsure(c, start, guess, found);
    if (NumberTraits<V>::any_of(unsure)) {
        // Copies, so that the others may stay in registers.
        const StepStart<V> same_start = start;
        const Velocities<V> same_guess = guess;
        StepMiddle<V> better = found;
        find_again(c, same_start, same_guess, unsure, better);
        return better;
    }
    return found;
}

/// What a step starts from. `gravity`: world axes; `velocity`: of the centre of mass, relative to the seen
/// fluid.
template <class V>
HWY_INLINE StepStart<V> step_start(const StepConstants& c, const Square<V>& to_world,
                                   const Triple<V>& gravity, V h, bool fluid_turns,
                                   const Triple<V>& seen_rotation, const Triple<V>& velocity,
                                   const Simulation<V>& simulation) {
    StepStart<V> start;
    start.h = h;
    start.omega = simulation.angular_velocity;
    start.velocity = to_centroid(c, simulation.angular_velocity, velocity);
    start.gravity = transposed_times(to_world, gravity);
    start.wake = simulation.wake;
    start.fluid_turns = fluid_turns;
    start.seen_rotation = fluid_turns ? transposed_times(to_world, seen_rotation) : no_vector<V>();
    const V munk_rate(c.munk_rate);
    start.wild = V(1.0) < (h * h) * (dot(start.omega, start.omega) +
                                     (munk_rate * munk_rate) * dot(start.velocity, start.velocity));
    return start;
}

/// A push in body axes about the centroid, over m* and l.
template <class V>
HWY_INLINE Push<V> push_at_centroid(const StepConstants& c, const Square<V>& to_world, const Push<V>& push) {
    const V force_unit(c.inverse_length / c.mass_scale);
    const Triple<V> force = transposed_times(to_world, push.force);
    const Triple<V> moment =
        transposed_times(to_world, push.moment) - cross(broadcast<V>(c.center_of_buoyancy), force);
    return {(force_unit * V(c.inverse_length)) * moment, force_unit * force};
}

/// Whether a body that meets turbulence sees it as a moving fluid.
HWY_INLINE bool sees_turbulence(const StepConstants& c) {
    return c.turbulence != Turbulence::none && c.langevin != Langevin::body_velocity;
}

/// One implicit step over h under a gravity (world axes). The middle of the step is guessed by the
/// acceleration of the step before; two passes make it good to second order and more, of which with noise the
/// second is taken where the first says that it matters.
///
/// Where the body sees fluid, the step is taken in the frame of that uniform stream, as in that of a current:
/// velocities are relative to it, and its acceleration is taken off gravity, for body and displaced fluid
/// alike (docs/theory, "The sampled turbulence"). `push`: null where there is none.
template <class V>
HWY_INLINE void implicit_step(const StepConstants& c, const Triple<V>& gravity, V h, bool sees_fluid,
                              const Stream<V>& stream, const Push<V>* push, Simulation<V>& simulation) {
    const Square<V> to_world = rotation_matrix(simulation.orientation);
    const V half = V(0.5) * h;
    const V rate = V(1.0) / h;
    Triple<V> relative_velocity = simulation.velocity;
    Triple<V> apparent_gravity = gravity;
    Triple<V> guess_acceleration = simulation.acceleration;
    Triple<V> pushed = no_vector<V>();  // by the stream's acceleration, about
    if (sees_fluid) {
        relative_velocity = relative_velocity - transposed_times(to_world, stream.begin);
    }
    const bool fluid_changes = sees_fluid && !stream.on_loads_alone;
    if (fluid_changes) {
        const Triple<V> acceleration = rate * (stream.end - stream.begin);
        apparent_gravity = apparent_gravity - acceleration;
        pushed = V(-c.weight * c.length) * transposed_times(to_world, acceleration);
        guess_acceleration = guess_acceleration + pushed;
    }
    StepStart<V> start = step_start(c, to_world, apparent_gravity, h, fluid_changes, stream.rotation,
                                    relative_velocity, simulation);
    start.wake_fluctuation = c.has_side_pressure
                                 ? V(c.inverse_length) * transposed_times(to_world, stream.wake_fluctuation)
                                 : no_vector<V>();
    start.is_pushed = push != nullptr;
    start.push =
        start.is_pushed ? push_at_centroid(c, to_world, *push) : Push<V>{no_vector<V>(), no_vector<V>()};
    const StepMiddle<V> found = found_middle(
        c, start,
        {start.omega + half * simulation.angular_acceleration,
         start.velocity + half * to_centroid(c, simulation.angular_acceleration, guess_acceleration)});
    if (c.wake_forms) {
        simulation.wake =
            wake_in_the_end(c, simulation.wake, h, found.omega, found.velocity, found.half_turn);
    }

    // The same turn that carried gravity: what gravity works is then what the height gives.
    const Triple<V> middle_velocity = from_centroid(c, found.omega, found.velocity);
    simulation.position =
        simulation.position + h * (to_world * turned_back(-found.half_turn, middle_velocity));
    simulation.orientation = turned_by(simulation.orientation, found.half_turn);
    const V whole = V(1.0) / found.theta;
    const Triple<V> rotation_change = whole * found.change.omega;
    const Triple<V> velocity_change = from_centroid(c, rotation_change, whole * found.change.velocity);
    simulation.angular_acceleration = rate * rotation_change;
    simulation.acceleration = rate * velocity_change;
    simulation.angular_velocity = simulation.angular_velocity + rotation_change;
    simulation.velocity = relative_velocity + velocity_change;
    if (sees_fluid) {
        simulation.position = simulation.position +
                              (stream.on_loads_alone ? h * stream.begin : half * (stream.begin + stream.end));
        simulation.velocity =
            simulation.velocity + transposed_times(rotation_matrix(simulation.orientation), stream.end);
    }
    if (fluid_changes) simulation.acceleration = simulation.acceleration - pushed;
}

/// The rate (1/s) at which the body turns, or would turn by its Munk moment in a sampled turbulence (m/s,
/// world axes).
template <class V>
HWY_INLINE V rotation_rate(const StepConstants& c, bool sees_fluid, const Triple<V>& seen_velocity,
                           const Simulation<V>& simulation) {
    Triple<V> velocity = centroid_velocity(c, simulation);
    if (sees_fluid) {
        velocity = velocity - V(c.inverse_length) *
                                  transposed_times(rotation_matrix(simulation.orientation), seen_velocity);
    }
    return root(dot(simulation.angular_velocity, simulation.angular_velocity)) +
           V(c.munk_rate) * root(dot(velocity, velocity));
}

/// Into how many equal parts the step is cut: each turns the body by at most 0.3 rad, as far as the limit on
/// their number allows. `seen_velocity`: when the step begins (m/s, world axes).
template <class V>
HWY_INLINE V substeps_of(const StepConstants& c, V h, bool sees_fluid, const Triple<V>& seen_velocity,
                         const Simulation<V>& simulation) {
    const V turns = h * rotation_rate(c, sees_fluid, seen_velocity, simulation) * V(1.0 / 0.3);
    return -whole_part(-smaller(V(most_substeps), larger(V(1.0), turns)));
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
