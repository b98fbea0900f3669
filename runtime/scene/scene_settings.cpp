#include "samara/scene/scene_settings.hpp"

#include "samara/core/simulation/simulation_surroundings.hpp"

namespace samara {

SimulationSettings simulation_settings(const Scene& scene, int runs, int threads) {
    return {.fluid = scene.fluid,
            .gravity = scene.gravity,
            .ground = scene.ground,
            .obstacles = scene.obstacles,
            .wind = scene.wind,
            .bodies_collide = scene.bodies_collide,
            .step = scene.step,
            .seed = scene.seed,
            .runs = runs,
            .threads = threads};
}

Simulation simulation_of(const Scene& scene, const std::vector<LoadedBody>& loaded, int runs, int threads) {
    Simulation simulation(simulation_settings(scene, runs, threads));
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        const SceneBody& body = scene.bodies[i];
        simulation.add(loaded[i], body, body, body.name);
    }
    return simulation;
}

Surroundings surroundings_of(const Scene& scene) {
    return surroundings_of(simulation_settings(scene, 1, 1));
}

}  // namespace samara
