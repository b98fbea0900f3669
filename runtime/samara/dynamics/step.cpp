#include "samara/dynamics/step.hpp"

#include "samara/dynamics/ground_contact.hpp"
#include "samara/dynamics/kernel/kernel.hpp"

namespace samara {

BodyState implicit_step(const ImmersedBody& body, const Vector3d& gravity, double time_step,
                        const BodyState& state) noexcept {
    BodyState result = state;
    const SeenFluid& seen = state.seen_fluid;
    const bool sees_fluid = !seen.velocity.isZero(0.0) || !seen.angular_velocity.isZero(0.0);
    kernel::implicit_step(body.constants, gravity, time_step, sees_fluid, result);
    return result;
}

StepResult advance(const ImmersedBody& body, const Surroundings& surroundings, double start, double time_step,
                   const BodyState& state, const Noise& noise, std::uint64_t step) noexcept {
    StepResult result{state, 1};
    result.substeps = kernel::begin_step(body.constants, time_step, noise, step, result.state);
    const double time = step_time(start, time_step, step);
    const Vector3d gravity = apparent_gravity(surroundings, time, step_time(start, time_step, step + 1));
    const double substep = time_step / result.substeps;
    for (int i = 0; i < result.substeps; ++i) {
        const BodyState before = result.state;
        kernel::implicit_step(body.constants, gravity, substep, body.turbulence != Turbulence::none,
                              result.state);
        if (!surroundings.ground) continue;
        const double end = time + (i + 1) * substep;
        touch_ground(body, ground_in_flow(surroundings, end - substep, end), substep, before, result.state);
    }
    return result;
}

double kinetic_energy(const ImmersedBody& body, const BodyState& state) noexcept {
    return 0.5 * state.velocity.dot(body.inertia * state.velocity);
}

}  // namespace samara
