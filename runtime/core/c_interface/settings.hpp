#pragma once

#include <string>

#include "samara.h"
#include "samara/core/body/body.hpp"
#include "samara/core/simulation/simulation.hpp"

namespace samara {

/// The content of a caller's samara_body_group.
struct GivenGroup : BodyPhysics, Release {
    std::string name;  ///< empty where the caller gave none
    OpenModels open;   ///< the models that the caller leaves to the body file
};

/// Returns the default content of samara_settings.
samara_settings default_settings();

/// Returns a caller's settings. Throws StatusError of SAMARA_INVALID_ARGUMENT, naming the member, where a
/// number is not finite or out of its range, or where the struct's size is unknown.
SimulationSettings read_settings(const samara_settings& settings);

/// Returns the default content of samara_body_group.
samara_body_group default_group();

/// Returns a caller's body group. Throws StatusError as read_settings() does.
GivenGroup read_group(const samara_body_group& group);

/// Returns the group with the models chosen that the caller leaves to the body file. Throws StatusError of
/// SAMARA_MISSING_DATA, in the words of the C interface, where the body lacks data that the group asks for.
GivenGroup of_body(const Body& body, GivenGroup group);

}  // namespace samara
