#pragma once

#include <string>

#include "foam-cases/bake_plan.hpp"

namespace samara {

/// Turbulence of the fluid far from the body: intensity (rms fluctuation over the flow's speed) and eddy
/// viscosity over the fluid's. Next to still, yet enough that the k-epsilon model wakes up.
inline constexpr double inflow_intensity = 0.01;
inline constexpr double inflow_viscosity_ratio = 1.0;

/// The file `parameters` of one case: the template's text with the case's values in place of the template's;
/// comments and further entries stay. Throws Error where the template lacks an entry.
std::string case_parameters(const std::string& template_text, const BakePlan& plan, const BakeCase& entry);

/// The entries of a file `parameters` that the mesh depends on.
std::string mesh_parameters_of(const std::string& parameters);

}  // namespace samara
