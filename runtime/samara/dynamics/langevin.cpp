#include "samara/dynamics/langevin.hpp"

#include <cmath>

#include "samara/dynamics/loads.hpp"

namespace samara {
namespace {

constexpr double kolmogorov_constant = 2.1;  // C_k of the paper's eq. 7; Pope, Phys. Fluids 26 (1983)

Vector3d normal_vector(const Noise& noise, std::uint64_t step, NoiseStream stream) noexcept {
    const auto normals = noise.normals(step, stream);
    return {normals[0], normals[1], normals[2]};
}

}  // namespace

TurbulenceLevel turbulence_level(const ImmersedBody& body, const Vector3d& velocity) noexcept {
    switch (body.turbulence) {
        case Turbulence::none:
            return {};
        case Turbulence::constant:
            return {body.turbulent_kinetic_energy, body.dissipation_rate};
        case Turbulence::table:
            break;
    }
    const double speed = velocity.norm();
    if (speed == 0.0) return {};
    const LoadEntry entry = look_up(*body.tables, velocity / speed, reynolds_number(body, speed));
    return {entry.turbulent_kinetic_energy * speed * speed,
            entry.dissipation_rate * speed * speed * speed / body.length};
}

SeenFluid advance_seen_fluid(const ImmersedBody& body, const TurbulenceLevel& level, const SeenFluid& seen,
                             double time_step, const Noise& noise, std::uint64_t step) noexcept {
    // Without turbulence there is no time scale: what was seen is gone.
    if (!(level.turbulent_kinetic_energy > 0.0)) return {};
    const double rate = 0.75 * kolmogorov_constant * level.dissipation_rate / level.turbulent_kinetic_energy;
    const double kept = std::exp(-rate * time_step);
    const double deviation =
        std::sqrt(2.0 / 3.0 * level.turbulent_kinetic_energy * -std::expm1(-2.0 * rate * time_step));
    return {kept * seen.velocity + deviation * normal_vector(noise, step, NoiseStream::seen_fluid),
            kept * seen.angular_velocity +
                deviation / body.length * normal_vector(noise, step, NoiseStream::seen_rotation)};
}

Vector6d advance_body_velocity(const ImmersedBody& body, const TurbulenceLevel& level,
                               const Vector6d& velocity, double time_step, const Noise& noise,
                               std::uint64_t step) noexcept {
    if (!(level.turbulent_kinetic_energy > 0.0)) return velocity;
    const double rate =
        (0.5 + 0.75 * kolmogorov_constant) * level.dissipation_rate / level.turbulent_kinetic_energy;
    const double diffusion = kolmogorov_constant * level.dissipation_rate;
    const double deviation = std::sqrt(diffusion / (2.0 * rate) * -std::expm1(-2.0 * rate * time_step));
    Vector6d result;
    result.head<3>() = velocity.head<3>() + std::sqrt(diffusion * time_step) / body.length *
                                                normal_vector(noise, step, NoiseStream::seen_rotation);
    result.tail<3>() = std::exp(-rate * time_step) * velocity.tail<3>() +
                       deviation * normal_vector(noise, step, NoiseStream::seen_fluid);
    return result;
}

}  // namespace samara
