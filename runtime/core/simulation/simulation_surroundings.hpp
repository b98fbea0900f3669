#pragma once

#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/simulation/simulation.hpp"

namespace samara {

/// What surrounds the bodies of a flight.
Surroundings surroundings_of(const SimulationSettings& settings);

}  // namespace samara
