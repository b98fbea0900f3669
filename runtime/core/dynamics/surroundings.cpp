#include "samara/core/dynamics/surroundings.hpp"

#include <cmath>
#include <numbers>

namespace samara {
namespace {

bool is_calm(const Gust& gust) noexcept {
    return gust.amplitude.isZero(0.0);
}

double phase(const Gust& gust, double time) noexcept {
    return 2.0 * std::numbers::pi * time / gust.period;
}

}  // namespace

Vector3d flow_velocity(const Surroundings& surroundings, double time) noexcept {
    const Gust& gust = surroundings.gust;
    if (is_calm(gust)) return surroundings.current;
    return surroundings.current + std::sin(phase(gust, time)) * gust.amplitude;
}

Vector3d flow_displacement(const Surroundings& surroundings, double time) noexcept {
    const Gust& gust = surroundings.gust;
    if (is_calm(gust)) return time * surroundings.current;
    const double half_sine = std::sin(0.5 * phase(gust, time));
    return time * surroundings.current +
           gust.period / std::numbers::pi * half_sine * half_sine * gust.amplitude;
}

Vector3d apparent_gravity(const Surroundings& surroundings, double begin, double end) noexcept {
    if (is_calm(surroundings.gust)) return surroundings.gravity;
    return surroundings.gravity -
           (flow_velocity(surroundings, end) - flow_velocity(surroundings, begin)) / (end - begin);
}

}  // namespace samara
