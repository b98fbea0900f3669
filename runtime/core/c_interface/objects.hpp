#pragma once

#include "samara.h"
#include "samara/core/simulation/simulation.hpp"
#include "samara/core/surface/surface.hpp"

// What stands behind the opaque types of samara.h.

struct samara_body {
    samara::LoadedBody loaded;
    samara::Surface flat;  ///< order 1
};

struct samara_simulation {
    samara::Simulation core;
};
