#pragma once

#include <filesystem>

#include "converter/cases/case_plan.hpp"
#include "converter/report/case_pictures.hpp"

namespace samara {

/// How a case of a plan came to what the tables hold: force, moment and k at its iterations, in the tables'
/// units, and the residuals of its last round, of the solver's log. Of k and the residuals, what is not there
/// stays empty. Throws Error where the forces are missing or damaged.
CaseHistory read_case_history(const std::filesystem::path& folder, const CasePlan& plan,
                              const PlannedCase& planned);

}  // namespace samara
