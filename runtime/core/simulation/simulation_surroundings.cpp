#include "samara/core/simulation/simulation_surroundings.hpp"

#include <memory>

namespace samara {

Surroundings surroundings_of(const SimulationSettings& settings) {
    const Wind wind = settings.wind.seeded(settings.seed);
    // A mean wind that is the same everywhere is a current, to the last bit.
    const Vector3d uniform = wind.profile ? Vector3d::Zero() : wind.velocity;
    return {
        .gravity = settings.gravity,
        .current = settings.fluid.current + uniform,
        .gust = settings.fluid.gust,
        .ground = settings.ground,
        .obstacles =
            settings.obstacles.empty() ? nullptr : std::make_shared<const ObstacleSet>(settings.obstacles),
        .wind = wind.is_field() ? std::make_shared<const WindField>(wind, settings.fluid.current) : nullptr};
}

}  // namespace samara
