#pragma once

#include <string>

#include "samara.h"
#include "samara/body/body.hpp"
#include "samara/c_interface/live_simulation.hpp"
#include "samara/c_interface/prepared_bodies.hpp"

// What stands behind the opaque types of samara.h.

struct samara_body {
    samara::Body body;
    std::string hash;      ///< of the file
    samara::Surface flat;  ///< order 1
    mutable samara::PreparedBodies prepared{};
};

struct samara_simulation {
    samara::LiveSimulation live;
};
