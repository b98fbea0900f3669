#pragma once

#include <nlohmann/json_fwd.hpp>

#include "samara/core/body/body.hpp"

namespace samara {

/// What a body weighs where nobody says otherwise, for people, on standard output. It has a mass.
void print_mass(const Body& body);

/// What a body holds, for people, on standard output.
void print_body(const Body& body);

/// The same as JSON: SI units, relative errors as fractions.
nlohmann::json body_as_json(const Body& body);

}  // namespace samara
