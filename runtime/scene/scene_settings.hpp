#pragma once

#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/simulation/simulation.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// What surrounds the bodies of a scene.
Surroundings surroundings_of(const Scene& scene);

/// The settings of a flight of the scene, for so many runs on so many threads (0: all cores).
SimulationSettings simulation_settings(const Scene& scene, int runs, int threads);

}  // namespace samara
