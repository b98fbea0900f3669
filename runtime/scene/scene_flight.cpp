#include "samara/scene/scene_flight.hpp"

#include "samara/core/flight/flight_surroundings.hpp"

namespace samara {

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
