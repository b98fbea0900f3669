#pragma once

#include <vector>

#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/simulation/simulation.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// What surrounds the bodies of a scene.
Surroundings surroundings_of(const Scene& scene);

/// The settings of a flight of the scene, for so many runs on so many threads (0: all cores).
SimulationSettings simulation_settings(const Scene& scene, int runs, int threads);

/// A flight with these settings and all bodies of the scene, in its order: its kind number i is
/// scene.bodies[i], which flies as `loaded[i]`. Throws Error where a body lacks what the scene asks of it or
/// starts below the ground or inside an obstacle.
Simulation simulation_of(const Scene& scene, const std::vector<LoadedBody>& loaded, int runs, int threads);

}  // namespace samara
