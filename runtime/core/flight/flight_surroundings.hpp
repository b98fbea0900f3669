#pragma once

#include "samara/core/dynamics/surroundings.hpp"
#include "samara/core/flight/flight.hpp"

namespace samara {

/// What surrounds the bodies of a flight.
Surroundings surroundings_of(const FlightSettings& settings);

}  // namespace samara
