#pragma once

#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/flight/flight.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// What surrounds the bodies of a flight.
Surroundings surroundings_of(const FlightSettings& settings);
/// What surrounds the bodies of a scene.
Surroundings surroundings_of(const Scene& scene);
/// How a scene is flown.
FlightSettings flight_settings(const Scene& scene, int runs, int threads);

}  // namespace samara
