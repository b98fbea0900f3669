#include "samara/core/dynamics/langevin.hpp"

#include "samara/core/kernel/kernel.hpp"

namespace samara {

TurbulenceLevel turbulence_level(const ImmersedBody& body, const Vector3d& velocity) noexcept {
    if (body.turbulence == Turbulence::none) return {};
    return kernel::turbulence_level(body.constants, velocity);
}

SeenFluid advance_seen_fluid(const ImmersedBody& body, const TurbulenceLevel& level, const SeenFluid& seen,
                             double time_step, const Noise& noise, std::uint64_t step) noexcept {
    BodyState state;
    state.seen_fluid = seen;
    kernel::advance_seen_fluid(body.constants, level, time_step, noise, step, state);
    return state.seen_fluid;
}

Vector6d advance_body_velocity(const ImmersedBody& body, const TurbulenceLevel& level,
                               const Vector6d& velocity, double time_step, const Noise& noise,
                               std::uint64_t step) noexcept {
    BodyState state;
    state.velocity = velocity;
    kernel::advance_body_velocity(body.constants, level, time_step, noise, step, state);
    return state.velocity;
}

}  // namespace samara
