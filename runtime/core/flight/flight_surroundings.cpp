#include "samara/core/flight/flight_surroundings.hpp"

#include <memory>

namespace samara {

Surroundings surroundings_of(const FlightSettings& settings) {
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

FlightSettings flight_settings(const Scene& scene, int runs, int threads) {
    return {.fluid = scene.fluid,
            .gravity = scene.gravity,
            .ground = scene.ground,
            .obstacles = scene.obstacles,
            .wind = scene.wind,
            .bodies_meet = scene.bodies_meet,
            .step = scene.step,
            .seed = scene.seed,
            .runs = runs,
            .threads = threads};
}

Surroundings surroundings_of(const Scene& scene) {
    return surroundings_of(flight_settings(scene, 1, 1));
}

}  // namespace samara
