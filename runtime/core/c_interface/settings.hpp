#pragma once

#include <string>

#include "samara.h"
#include "samara/core/body/body.hpp"
#include "samara/core/simulation/simulation.hpp"

namespace samara {

/// What a caller's samara_body_group says.
struct GivenGroup : BodyPhysics, Release {
    std::string name;  ///< empty where the caller gave none
};

/// The settings with which an empty samara_settings is filled.
samara_settings default_settings();

/// Checks a caller's settings. Throws Fault of SAMARA_INVALID_ARGUMENT, naming the member, where a number is
/// not finite or out of its range, or where the struct is not of a known size.
SimulationSettings read_settings(const samara_settings& settings);

/// The kind with which an empty samara_body_group is filled.
samara_body_group default_group();

/// Checks a caller's kind, as read_settings does.
GivenGroup read_group(const samara_body_group& group);

/// Throws Fault of SAMARA_MISSING_DATA, in the words of the C interface, where the body lacks what the kind
/// asks for.
void require_data(const Body& body, const GivenGroup& group);

}  // namespace samara
