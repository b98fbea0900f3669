#include "samara/core/integrator/step.hpp"

#include "samara/core/contact/ground_contact.hpp"
#include "samara/core/kernel/kernel.hpp"

namespace samara {

BodyState implicit_step(const ImmersedBody& body, const Vector3d& gravity, double time_step,
                        const BodyState& state) noexcept {
    return implicit_step(body, gravity, time_step, state, state.seen_fluid);
}

BodyState implicit_step(const ImmersedBody& body, const Vector3d& gravity, double time_step,
                        const BodyState& state, const SeenFluid& seen_fluid) noexcept {
    BodyState result = state;
    result.seen_fluid = seen_fluid;
    const bool moves = !state.seen_fluid.velocity.isZero(0.0) || !seen_fluid.velocity.isZero(0.0) ||
                       !seen_fluid.angular_velocity.isZero(0.0);
    kernel::implicit_step(
        body.constants, gravity, time_step,
        {state.seen_fluid.velocity, seen_fluid.velocity, seen_fluid.angular_velocity, moves, false}, 0, 1,
        nullptr, result);
    return result;
}

StepResult advance(const ImmersedBody& body, const Surroundings& surroundings, double start, double time_step,
                   const BodyState& state, const Noise& noise, std::uint64_t step, const Wrench* external,
                   ContactRecord* met) noexcept {
    StepResult result{state, 0};
    const double time = step_time(start, time_step, step);
    const double end = step_time(start, time_step, step + 1);
    const SeenFluid& seen = state.seen_fluid;
    if (state.at_rest && seen.velocity.isZero(0.0) && seen.angular_velocity.isZero(0.0) &&
        is_steady(body, surroundings)) {
        stay_on(ground_in_flow(surroundings, time, end), result.state);
        return result;
    }
    const WindMeeting wind(body, surroundings, start, time_step);
    const Vector3d gravity = apparent_gravity(surroundings, time, end);
    if (!has_ground(surroundings)) {
        const kernel::BlockSteps whole{.gravities = &gravity,
                                       .start = start,
                                       .time_step = time_step,
                                       .first_step = step,
                                       .steps = 1,
                                       .wind = wind.source()};
        result.substeps =
            kernel::advance_one(body.constants, whole, noise, external, result.state).most_substeps;
        result.wind_is_sound = wind.is_sound();
        return result;
    }
    const auto [parts, stream] =
        kernel::begin_step(body.constants, time_step, wind.source(), noise, step, result.state);
    result.substeps = parts;
    result.wind_is_sound = wind.is_sound();
    const double substep = time_step / result.substeps;
    BodyState before = state;
    for (int i = 0; i < result.substeps; ++i) {
        kernel::implicit_step(body.constants, gravity, substep, stream, i, result.substeps, external,
                              result.state);
        const double now = time + (i + 1) * substep;
        touch_ground(body, ground_in_flow(surroundings, now - substep, now), substep, before, result.state,
                     met);
        before = result.state;
    }
    return result;
}

double kinetic_energy(const ImmersedBody& body, const BodyState& state) noexcept {
    return 0.5 * state.velocity.dot(body.inertia * state.velocity);
}

}  // namespace samara
