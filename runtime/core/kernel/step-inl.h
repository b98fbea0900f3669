// One implicit step (docs/explanation/integrator.md#the-step).
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

/// BodyState of body_state.hpp in the step's numbers.
template <class V>
struct StepState {
    Triple<PositionOf<V>> position;
    Quaternion<V> orientation;
    Triple<V> angular_velocity, velocity;
    Triple<V> sampled_velocity, sampled_rotation;
    Triple<V> angular_acceleration, acceleration;
    WakeState<V> wake;
};

/// Returns the velocity (or acceleration) of the centroid from that of the centre of mass, in units of l.
template <class V>
HWY_INLINE Triple<V> to_centroid(const ConstantsOf<V>& c, const Triple<V>& angular,
                                 const Triple<V>& velocity) {
    if (!c.off_center) return V(c.inverse_length) * velocity;
    return V(c.inverse_length) * (velocity + cross(angular, broadcast<V>(c.center_of_buoyancy)));
}
/// Returns the velocity of the centre of mass: the inverse of to_centroid().
template <class V>
HWY_INLINE Triple<V> from_centroid(const ConstantsOf<V>& c, const Triple<V>& angular,
                                   const Triple<V>& velocity) {
    if (!c.off_center) return V(c.length) * velocity;
    return V(c.length) * velocity - cross(angular, broadcast<V>(c.center_of_buoyancy));
}

/// Returns the velocity of the centroid, in l a second.
template <class V>
HWY_INLINE Triple<V> centroid_velocity(const ConstantsOf<V>& c, const StepState<V>& step_state) {
    return to_centroid(c, step_state.angular_velocity, step_state.velocity);
}

template <class V>
struct Velocities {
    Triple<V> omega, velocity;
};

/// The sampled turbulence's velocity (m/s, world axes) at the begin and the end of a step: between them it
/// changes evenly. Its rotation (rad/s) is held. Where it affects the loads alone it neither changes nor
/// rotates.
template <class V>
struct Stream {
    Triple<V> begin, end, rotation;
    bool on_loads_alone = false;
    Triple<V> wake_fluctuation;  ///< the part by the body's own wake
};

/// Returns the stream of substep `i` of a step that is cut into `substeps`, from that of the whole step.
template <class V>
HWY_INLINE Stream<V> part_of(const Stream<V>& whole, int i, V substeps) {
    if (whole.on_loads_alone) return whole;
    const Triple<V> difference = whole.end - whole.begin;
    const Triple<V> begin = i == 0 ? whole.begin : whole.begin + (V(i) / substeps) * difference;
    const Triple<V> end = whole.begin + (V(i + 1) / substeps) * difference;
    return {begin, select(V(i + 1) < substeps, end, whole.end), whole.rotation, false,
            whole.wake_fluctuation};
}

/// A host's wrench: moment about the centre of mass and force (world axes, in the shape's own units).
template <class V>
struct Push {
    Triple<V> moment, force;
};

/// The start of a step, which its passes share. Velocities are relative to the sampled turbulence.
template <class V>
struct StepStart {
    V h;
    Triple<V> omega, velocity;
    Triple<V> gravity, sampled_rotation, wake_fluctuation;  // body axes
    WakeState<V> wake;                                      // at the begin of the step
    bool fluid_rotates;
    bool is_pushed;
    Push<V> push;      // body axes, about the centroid
    V own_excess;      // the body's own mass over that of its constants, less one
    V isotropic_mass;  // over m*: 1 where that is zero
    V weight;          // as of the constants
    /// Whether the body rotates by more than a radian: its system is then solved once more for the rounding
    /// errors, since the elimination does not look for the best pivots.
    typename NumberTraits<V>::Mask rotates_far;
};

/// The velocities in the middle of the step, their differences from the start's, and the rotation they were
/// found with.
template <class V>
struct StepMiddle {
    Triple<V> omega, velocity;
    Velocities<V> change;
    Triple<V> half_rotation;
    V theta;
    V stiffness;  // of the translation
};

/// The error of a step, relative to the body's speed, up to which its middle is found in one pass; and the
/// stiffness of its drag up to which that may be so (at 1 one pass would hardly settle at the terminal speed,
/// above it, with h D / K, not at all).
inline constexpr double one_pass_tolerance = 3e-5;
inline constexpr double one_pass_stiffness = 0.5;

/// Returns the stiffness of the drag: h max(D_ii / K_ii) of rotation and translation.
template <class V>
struct Stiffness {
    V angular, linear;
};
template <class V>
HWY_INLINE Stiffness<V> stiffness(const ConstantsOf<V>& c, const LoadBlocks<V>& loads, V h) {
    const auto of_block = [h](const Square<V>& block, const Triple<RealOf<V>>& inverse_inertia) HWY_ATTR {
        return h * largest_of(product_of_each(diagonal_of(block), broadcast<V>(inverse_inertia)));
    };
    return {of_block(loads.moment_by_rotation, c.inverse_angular),
            of_block(loads.force_by_velocity, c.inverse_linear)};
}

/// The step's matrix by its blocks, factorised for solving.
template <class V>
struct StepMatrix {
    Square<V> angular, angular_linear, linear_angular, linear;
    Square<V> linear_inverse, linear_by_angular, angular_inverse;

    /// Eliminates the velocity, then the rest for the angular velocity.
    HWY_INLINE void factorise() {
        linear_inverse = inverse(linear);
        linear_by_angular = linear_inverse * linear_angular;
        angular_inverse = inverse(angular - angular_linear * linear_by_angular);
    }
    [[nodiscard]] HWY_INLINE Velocities<V> solved_for(const Triple<V>& moment, const Triple<V>& force) const {
        const Triple<V> rest = linear_inverse * force;
        const Triple<V> omega = angular_inverse * (moment - angular_linear * rest);
        return {omega, rest - linear_by_angular * omega};
    }
};

/// Rotates a vector that is fixed in the world back by the body's rotation in half a step.
template <class V>
struct HalfTurn {
    Triple<V> half_rotation;
    HWY_INLINE Triple<V> operator()(const Triple<V>& a) const { return rotated_back(half_rotation, a); }
};

/// The equations of the midpoint step, as their stages assemble them: `matrix` times the changes of the
/// velocities is `step` times moment and force, those at the step's start.
template <class V>
struct StepSystem {
    StepMatrix<V> matrix;
    Triple<V> angular_momentum, momentum;  ///< in the middle; of the linear one the part of directed_inertia
    Triple<V> moment, force;
    V step;  ///< theta h
};

/// Stage 1: the inertia, and the momenta in the middle.
template <class V>
HWY_INLINE void add_inertia(const ConstantsOf<V>& c, const StepStart<V>& start, const StepMiddle<V>& middle,
                            StepSystem<V>& system) {
    // The part of the linear momentum along the velocity (m* v, in units of m*) acts as a force alone: as p x
    // v its moment would vanish only where the v inside p and the one it acts on are parallel, and otherwise
    // spin even a sphere.
    StepMatrix<V>& matrix = system.matrix;
    matrix.angular = broadcast_symmetric<V>(c.inertia_angular);
    const Square<V> directed_inertia = broadcast_symmetric<V>(c.directed_inertia);
    matrix.linear = plus_diagonal(directed_inertia, start.isotropic_mass);
    if (c.keeps_thickness) {
        matrix.angular = matrix.angular + start.own_excess * broadcast_symmetric<V>(c.own_angular);
    }
    system.angular_momentum = matrix.angular * middle.omega;
    system.momentum = directed_inertia * middle.velocity;
    if (c.coupled) {
        matrix.angular_linear = broadcast<V>(c.inertia_coupling);
        if (c.keeps_thickness) {
            matrix.angular_linear = matrix.angular_linear + start.own_excess * broadcast<V>(c.own_coupling);
        }
        matrix.linear_angular = transposed(matrix.angular_linear);
        system.angular_momentum = system.angular_momentum + matrix.angular_linear * middle.velocity;
        system.momentum = system.momentum + matrix.linear_angular * middle.omega;
    } else {
        matrix.angular_linear = no_matrix<V>();
        matrix.linear_angular = matrix.angular_linear;
    }
}

/// Stage 2: what the rotating axes, weight and a host's push do.
template <class V>
HWY_INLINE void add_forces(const ConstantsOf<V>& c, const StepStart<V>& start, const StepMiddle<V>& middle,
                           StepSystem<V>& system) {
    const HalfTurn<V> under_body{middle.half_rotation};
    const Triple<V> gravity = under_body(start.gravity);
    system.moment = cross(system.angular_momentum, start.omega) + cross(system.momentum, start.velocity);
    system.force = start.weight * gravity + cross(system.momentum, start.omega) -
                   start.isotropic_mass * cross(middle.omega, start.velocity);
    if (c.off_center) {
        system.moment =
            system.moment + (V(1.0) + start.own_excess) * cross(broadcast<V>(c.weight_moment), gravity);
    }
    if (start.is_pushed) {
        system.moment = system.moment + under_body(start.push.moment);
        system.force = system.force + under_body(start.push.force);
    }
}

/// Stage 3: the loads of the fluid, whose stiffness tells where in the step the middle lies (theta).
template <class V>
HWY_INLINE void add_loads(const ConstantsOf<V>& c, const StepStart<V>& start, StepMiddle<V>& middle,
                          StepSystem<V>& system) {
    const HalfTurn<V> under_body{middle.half_rotation};
    StepMatrix<V>& matrix = system.matrix;
    Shares<V> shares{V(1.0), V(1.0)};
    if (c.wake_forms) {
        shares = shares_of(
            wake_in_the_middle(c, start.wake, start.h, middle.omega, middle.velocity, middle.half_rotation));
    }
    LoadBlocks<V> loads;
    if (start.fluid_rotates) {
        const Triple<V> fluid_rotation = under_body(start.sampled_rotation);
        loads = relative_load_blocks(c, middle.omega - fluid_rotation, middle.velocity, middle.omega,
                                     shares.moment);
        system.moment = system.moment + loads.moment_by_rotation * fluid_rotation;
        system.force = system.force + loads.force_by_rotation * fluid_rotation;
    } else {
        loads = relative_load_blocks(c, middle.omega, middle.velocity, middle.omega, shares.moment);
    }
    add_transport(c, middle.omega, middle.velocity, shares.transport, loads);
    if (c.has_side_pressure) add_side_pressure(c, middle.velocity, under_body(start.wake_fluctuation), loads);
    const Stiffness<V> stiff = stiffness(c, loads, start.h);
    const V z = larger(stiff.angular, stiff.linear);
    middle.theta = (V(3.0) + z) / (V(6.0) + z);
    middle.stiffness = stiff.linear;
    system.step = middle.theta * start.h;
    matrix.angular = matrix.angular + system.step * loads.moment_by_rotation;
    matrix.angular_linear = matrix.angular_linear + system.step * loads.moment_by_velocity;
    matrix.linear_angular = matrix.linear_angular + system.step * loads.force_by_rotation;
    matrix.linear = matrix.linear + system.step * loads.force_by_velocity;
    system.moment =
        system.moment - (loads.moment_by_rotation * start.omega + loads.moment_by_velocity * start.velocity);
    system.force =
        system.force - (loads.force_by_rotation * start.omega + loads.force_by_velocity * start.velocity);
}

/// Stage 4: the rotation of the momenta over the step. The matrix is complete with it and is factorised.
template <class V>
HWY_INLINE void add_rotation_of_momenta(const StepStart<V>& start, const StepMiddle<V>& middle,
                                        StepSystem<V>& system) {
    StepMatrix<V>& matrix = system.matrix;
    matrix.angular = plus_cross(matrix.angular, -system.step * system.angular_momentum);
    matrix.angular_linear = plus_cross(matrix.angular_linear, -system.step * system.momentum);
    matrix.linear_angular = plus_cross(matrix.linear_angular, -system.step * system.momentum);
    matrix.linear = plus_cross(matrix.linear, system.step * start.isotropic_mass * middle.omega);
    matrix.factorise();
}

/// Stage 5: the changes of the velocities, refined once where the body rotates far in the step.
template <class V>
HWY_INLINE Velocities<V> solved_change(const StepSystem<V>& system, const StepStart<V>& start) {
    const StepMatrix<V>& matrix = system.matrix;
    const Triple<V> right_moment = system.step * system.moment;
    const Triple<V> right_force = system.step * system.force;
    Velocities<V> change = matrix.solved_for(right_moment, right_force);
    if (NumberTraits<V>::any_of(start.rotates_far)) {
        const Velocities<V> more = matrix.solved_for(
            right_moment - matrix.angular * change.omega - matrix.angular_linear * change.velocity,
            right_force - matrix.linear_angular * change.omega - matrix.linear * change.velocity);
        change.omega = select(start.rotates_far, change.omega + more.omega, change.omega);
        change.velocity = select(start.rotates_far, change.velocity + more.velocity, change.velocity);
    }
    return change;
}

/// Solves the step with the loads and the transport taken at the middle that was found or guessed before. The
/// unknowns are the changes of the velocities: solving for the velocities themselves would drift by a
/// rounding error a step.
template <class V>
HWY_INLINE void solve_midpoint(const ConstantsOf<V>& c, const StepStart<V>& start, StepMiddle<V>& middle) {
    middle.half_rotation = (V(0.5) * start.h) * middle.omega;
    middle.theta = V(0.5);
    StepSystem<V> system;
    system.step = V(0.5) * start.h;
    add_inertia(c, start, middle, system);
    add_forces(c, start, middle, system);
    if (c.loads != Loads::none) add_loads(c, start, middle, system);
    add_rotation_of_momenta(start, middle, system);
    middle.change = solved_change(system, start);
    middle.omega = start.omega + middle.change.omega;
    middle.velocity = start.velocity + middle.change.velocity;
}

template <class Condition, class V>
HWY_INLINE StepMiddle<V> select(Condition condition, const StepMiddle<V>& a, const StepMiddle<V>& b) {
    return {select(condition, a.omega, b.omega),
            select(condition, a.velocity, b.velocity),
            {select(condition, a.change.omega, b.change.omega),
             select(condition, a.change.velocity, b.change.velocity)},
            select(condition, a.half_rotation, b.half_rotation),
            select(condition, a.theta, b.theta),
            select(condition, a.stiffness, b.stiffness)};
}

/// Returns whether a guessed middle needs a second pass: always where a body has no noise. Noise, which is
/// not smooth, has a larger error in a step than the second pass would remove. Loads and transport go with
/// the square of the velocity: to first order, a middle from a guess with the error d has the error 2 d / u
/// of the velocity's change. One pass is of second order too, where drag is not stiff.
template <class V>
HWY_INLINE typename NumberTraits<V>::Mask needs_second_pass(const ConstantsOf<V>& c,
                                                            const StepStart<V>& start,
                                                            const Velocities<V>& guess,
                                                            const StepMiddle<V>& found) {
    const V tip_square(c.tip_square);
    const auto square = [&](const Triple<V>& omega, const Triple<V>& velocity)
                            HWY_ATTR { return dot(velocity, velocity) + tip_square * dot(omega, omega); };
    const V off = square(found.omega - guess.omega, found.velocity - guess.velocity);
    const V change = square(found.change.omega, found.change.velocity);
    const V speed = square(found.omega, found.velocity);
    const bool is_noisy = c.turbulence != Turbulence::none;
    const V allowed(is_noisy ? one_pass_tolerance * one_pass_tolerance / 16.0 : -1.0);
    const auto far_off = allowed * (speed * speed) < off * change;
    return either(either(far_off, V(one_pass_stiffness) < found.stiffness), start.rotates_far);
}

/// Returns the middle that a second pass finds, for bodies where it matters. Not inlined: most steps need
/// none.
template <class V>
HWY_NOINLINE void second_pass(const ConstantsOf<V>& c, const StepStart<V>& start, const Velocities<V>& guess,
                              typename NumberTraits<V>::Mask repeated, StepMiddle<V>& middle) {
    StepMiddle<V> found = middle;
    // Where drag is stiff, a middle from the speed alone would oscillate about the terminal speed: halfway to
    // the guess lies Newton's root. Elsewhere the middle stays, of second order.
    const V square = middle.stiffness * middle.stiffness;
    const V back = V(0.5) * square / (V(36.0) + square);
    found.velocity = middle.velocity + back * (guess.velocity - middle.velocity);
    solve_midpoint(c, start, found);
    middle = select(repeated, found, middle);
}

/// Returns the middle of the step from velocities guessed there: by one pass, or by two where it matters.
template <class V>
HWY_INLINE StepMiddle<V> found_middle(const ConstantsOf<V>& c, const StepStart<V>& start,
                                      const Velocities<V>& guess) {
    StepMiddle<V> found;
    found.omega = guess.omega;
    found.velocity = guess.velocity;
    found.stiffness = V(0.0);
    solve_midpoint(c, start, found);
    const auto repeated = needs_second_pass(c, start, guess, found);
    if (NumberTraits<V>::any_of(repeated)) {
        // Copies, so that the others may stay in registers.
        const StepStart<V> same_start = start;
        const Velocities<V> same_guess = guess;
        StepMiddle<V> better = found;
        second_pass(c, same_start, same_guess, repeated, better);
        return better;
    }
    return found;
}

/// Returns the weight over gravity, as StepConstants has it, of a body with more mass of its own.
template <class V>
HWY_INLINE V weight_of(const ConstantsOf<V>& c, V own_excess) {
    return V(c.weight) + own_excess * V(c.own_mass * c.inverse_length);
}

/// Returns the start of a step. `gravity`: world axes; `velocity`: of the centre of mass, relative to the
/// sampled turbulence.
template <class V>
HWY_INLINE StepStart<V> step_start(const ConstantsOf<V>& c, const Square<V>& to_world,
                                   const Triple<V>& gravity, V h, bool fluid_rotates,
                                   const Triple<V>& sampled_rotation, const Triple<V>& velocity, V own_excess,
                                   const StepState<V>& step_state) {
    StepStart<V> start;
    start.h = h;
    start.own_excess = own_excess;
    start.isotropic_mass = V(1.0) + own_excess * V(c.own_mass);
    start.weight = weight_of(c, own_excess);
    start.omega = step_state.angular_velocity;
    start.velocity = to_centroid(c, step_state.angular_velocity, velocity);
    start.gravity = transposed_times(to_world, gravity);
    start.wake = step_state.wake;
    start.fluid_rotates = fluid_rotates;
    start.sampled_rotation = fluid_rotates ? transposed_times(to_world, sampled_rotation) : no_vector<V>();
    const V munk_rate(c.munk_rate);
    start.rotates_far = V(1.0) < (h * h) * (dot(start.omega, start.omega) +
                                            (munk_rate * munk_rate) * dot(start.velocity, start.velocity));
    return start;
}

/// Returns a host's wrench in body axes about the centroid, in units of m* and l.
template <class V>
HWY_INLINE Push<V> push_at_centroid(const ConstantsOf<V>& c, const Square<V>& to_world, const Push<V>& push) {
    const V force_unit(c.inverse_length / c.mass_scale);
    const Triple<V> force = transposed_times(to_world, push.force);
    const Triple<V> moment =
        transposed_times(to_world, push.moment) - cross(broadcast<V>(c.center_of_buoyancy), force);
    return {(force_unit * V(c.inverse_length)) * moment, force_unit * force};
}

/// Returns whether turbulence is a moving fluid for the body.
template <class Real>
HWY_INLINE bool sees_turbulence(const StepConstantsIn<Real>& c) {
    return c.turbulence != Turbulence::none && c.langevin != Langevin::body_velocity;
}

/// Takes one implicit step over h under a gravity (world axes). The middle of the step is guessed by the
/// acceleration of the step before; two passes make it good to second order and more, of which with noise the
/// second is taken only where the first says that it matters.
///
/// Where the body samples turbulence, the step is taken in the frame of that uniform stream, as in that of a
/// current: velocities are relative to it, and its acceleration is subtracted from gravity, for body and
/// displaced fluid alike (docs/explanation/noise-and-wake.md#seen-fluid). `push`: null where there is none.
/// `own_excess`: the body's own mass over that of the constants, less one.
template <class V>
HWY_INLINE void implicit_step(const ConstantsOf<V>& c, const Triple<V>& gravity, V h, bool sees_fluid,
                              const Stream<V>& stream, const Push<V>* push, V own_excess,
                              StepState<V>& step_state) {
    const Square<V> to_world = rotation_matrix(step_state.orientation);
    const V half = V(0.5) * h;
    const V rate = V(1.0) / h;
    Triple<V> relative_velocity = step_state.velocity;
    Triple<V> apparent_gravity = gravity;
    Triple<V> guess_acceleration = step_state.acceleration;
    Triple<V> pushed = no_vector<V>();  // caused by the stream's acceleration, about
    if (sees_fluid) {
        relative_velocity = relative_velocity - transposed_times(to_world, stream.begin);
    }
    const bool fluid_changes = sees_fluid && !stream.on_loads_alone;
    if (fluid_changes) {
        const Triple<V> acceleration = rate * (stream.end - stream.begin);
        apparent_gravity = apparent_gravity - acceleration;
        pushed = -(V(c.length) * weight_of(c, own_excess)) * transposed_times(to_world, acceleration);
        guess_acceleration = guess_acceleration + pushed;
    }
    StepStart<V> start = step_start(c, to_world, apparent_gravity, h, fluid_changes, stream.rotation,
                                    relative_velocity, own_excess, step_state);
    start.wake_fluctuation = c.has_side_pressure
                                 ? V(c.inverse_length) * transposed_times(to_world, stream.wake_fluctuation)
                                 : no_vector<V>();
    start.is_pushed = push != nullptr;
    start.push =
        start.is_pushed ? push_at_centroid(c, to_world, *push) : Push<V>{no_vector<V>(), no_vector<V>()};
    const StepMiddle<V> found = found_middle(
        c, start,
        {start.omega + half * step_state.angular_acceleration,
         start.velocity + half * to_centroid(c, step_state.angular_acceleration, guess_acceleration)});
    if (c.wake_forms) {
        step_state.wake =
            wake_in_the_end(c, step_state.wake, h, found.omega, found.velocity, found.half_rotation);
    }

    // The same rotation as gravity's: the work of gravity is then exactly that of the height.
    const Triple<V> middle_velocity = from_centroid(c, found.omega, found.velocity);
    step_state.position =
        moved(step_state.position, h * (to_world * rotated_back(-found.half_rotation, middle_velocity)));
    step_state.orientation = rotated_by(step_state.orientation, found.half_rotation);
    const V whole = V(1.0) / found.theta;
    const Triple<V> rotation_change = whole * found.change.omega;
    const Triple<V> velocity_change = from_centroid(c, rotation_change, whole * found.change.velocity);
    step_state.angular_acceleration = rate * rotation_change;
    step_state.acceleration = rate * velocity_change;
    step_state.angular_velocity = step_state.angular_velocity + rotation_change;
    step_state.velocity = relative_velocity + velocity_change;
    if (sees_fluid) {
        step_state.position =
            moved(step_state.position,
                  stream.on_loads_alone ? h * stream.begin : half * (stream.begin + stream.end));
        step_state.velocity =
            step_state.velocity + transposed_times(rotation_matrix(step_state.orientation), stream.end);
    }
    if (fluid_changes) step_state.acceleration = step_state.acceleration - pushed;
}

/// Returns the rate (1/s) at which the body rotates, or would rotate by its Munk moment in a sampled
/// turbulence (m/s, world axes).
template <class V>
HWY_INLINE V rotation_rate(const ConstantsOf<V>& c, bool sees_fluid, const Triple<V>& sampled_velocity,
                           const StepState<V>& step_state) {
    Triple<V> velocity = centroid_velocity(c, step_state);
    if (sees_fluid) {
        velocity = velocity - V(c.inverse_length) *
                                  transposed_times(rotation_matrix(step_state.orientation), sampled_velocity);
    }
    return root(dot(step_state.angular_velocity, step_state.angular_velocity)) +
           V(c.munk_rate) * root(dot(velocity, velocity));
}

/// Returns the number of substeps of the step: each rotates the body by at most 0.3 rad, as far as the limit
/// on their number allows. `sampled_velocity`: at the begin of the step (m/s, world axes).
template <class V>
HWY_INLINE V substeps_of(const ConstantsOf<V>& c, V h, bool sees_fluid, const Triple<V>& sampled_velocity,
                         const StepState<V>& step_state) {
    const V substeps = h * rotation_rate(c, sees_fluid, sampled_velocity, step_state) * V(1.0 / 0.3);
    return -whole_part(-smaller(V(most_substeps), larger(V(1.0), substeps)));
}

}  // namespace samara::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
