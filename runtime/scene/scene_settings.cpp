#include "samara/scene/scene_settings.hpp"

#include "samara/core/simulation/world_pose.hpp"

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

Surroundings surroundings_of(const Scene& scene) {
    return surroundings_of(simulation_settings(scene, 1, 1));
}

}  // namespace samara
