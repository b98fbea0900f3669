#pragma once

#include <string>

#include "converter/falls/free_fall.hpp"
#include "foam-cases/bake/bake_plan.hpp"

namespace samara {

/// The file `parameters` of one case: the template's text with the case's values in place of the template's;
/// comments and further entries stay. Throws Error where the template lacks an entry.
std::string case_parameters(const std::string& template_text, const BakePlan& plan, const BakeCase& entry);

/// The same of a fall's case.
std::string fall_parameters(const std::string& template_text, const BakePlan& plan, const FreeFall& fall);

/// The file `parameters` of a case that only makes a mesh, and its entries that the mesh depends on.
std::string mesh_case_parameters(const std::string& template_text, const FlowMesh& mesh);
std::string mesh_parameters_of(const std::string& parameters);

}  // namespace samara
