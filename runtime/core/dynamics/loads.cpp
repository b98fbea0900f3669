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

}  // namespace samara
