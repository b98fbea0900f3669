#pragma once

#include <string>

#include "foam-cases/bake_plan.hpp"

namespace samara {

/// The file `parameters` of one case: the template's text with the case's values in place of the template's;
/// comments and further entries stay. Throws Error where the template lacks an entry.
std::string case_parameters(const std::string& template_text, const BakePlan& plan, const BakeCase& entry);

/// The entries of a file `parameters` that the mesh depends on.
std::string mesh_parameters_of(const std::string& parameters);

}  // namespace samara
