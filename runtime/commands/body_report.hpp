#pragma once

#include <nlohmann/json_fwd.hpp>

#include "samara/core/body/body.hpp"

namespace samara {

/// Prints the mass of a body's file, which scenes use by default, on standard output. The body must have a
/// mass.
void print_mass(const Body& body);

/// Prints the models of a body's file, which scenes use by default, on standard output. The body must have
/// them.
void print_recommended(const Body& body);

/// Prints a description of a body on standard output.
void print_body(const Body& body);

/// Returns a description of a body as JSON: SI units, relative errors as fractions.
nlohmann::json body_as_json(const Body& body);

}  // namespace samara
