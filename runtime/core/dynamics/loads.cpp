#include "samara/core/dynamics/loads.hpp"

#include <algorithm>
#include <cmath>

#include "samara/core/kernel/kernel.hpp"

namespace samara {

LoadMatrices load_matrices(const ImmersedBody& body, const Vector6d& velocity,
                           const Vector3d& sampled_rotation, const Vector3d& wake_fluctuation,
                           const WakeShares& shares) noexcept {
    if (body.loads == Loads::none) return {};
    return kernel::load_matrices(body.constants, velocity, sampled_rotation, wake_fluctuation, shares);
}

WakeShares shares_of(const Wake& wake) noexcept {
    // They lie between zero and one, unless an integrator tries a stage that is far off.
    const double square = std::min(1.0, wake.heading.squaredNorm());
    const double fourth = square * square;
    return {std::clamp(wake.formed, 0.0, 1.0), fourth * fourth};
}

WakeRates wake_rates(const ImmersedBody& body, const Vector6d& relative_velocity) noexcept {
    const Vector3d velocity = relative_velocity.tail<3>();
    const Vector3d spin = body.spin_about_symmetry * relative_velocity.head<3>();
    if (!body.constants.wake_forms || velocity.isZero(0.0)) return {0.0, 0.0, spin};
    const double combined =
        std::hypot(velocity.norm(), body.dynamic.half_length * relative_velocity.head<3>().norm());
    const double formation =
        combined * velocity.norm() / std::sqrt(velocity.dot(body.squared_formation_length * velocity));
    return {formation, formation * wake_formation_lengths / body.dynamic.settling_length, spin};
}

double reynolds_number(const ImmersedBody& body, double speed) noexcept {
    return speed * body.length * body.fluid_density / body.viscosity;
}

TurbulenceLevel turbulence_level(const ImmersedBody& body, const Vector3d& velocity) noexcept {
    if (body.turbulence == Turbulence::none) return {};
    return kernel::turbulence_level(body.constants, velocity);
}

double wake_renewal_rate(const ImmersedBody& body, const Vector3d& velocity) noexcept {
    const TurbulenceLevel level = turbulence_level(body, velocity);
    if (!(level.turbulent_kinetic_energy > 0.0)) return 0.0;
    const WakeNoise& noise = body.constants.wake_noise;
    return noise.rate_by_dissipation > 0.0
               ? noise.rate_by_dissipation * level.dissipation_rate / level.turbulent_kinetic_energy
               : noise.rate_by_way * velocity.norm() / body.length;
}

}  // namespace samara
