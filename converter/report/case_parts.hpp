#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "converter/cases/case_plan.hpp"
#include "samara/reports/report_program.hpp"

namespace samara {

/// Reads the parts that a folder of solved cases adds to the report of its body: the meshes with checkMesh's
/// verdicts, drawn where the plane of the shortest and longest axis cuts them, y+ of the cases, the histories
/// in which they settled, and the solved free falls compared with the runtime's by the body's coefficients.
/// Missing and damaged parts are listed in `missing`. Throws Error where plan.json is damaged or of another
/// body.
CasesReport read_cases_for_report(const std::filesystem::path& folder, const Body& body,
                                  const std::function<void(double share)>& progress);

/// The history of a case while it was solved; values that are not finite are left out.
struct CaseHistory {
    std::string name;
    std::vector<double> iterations;
    std::vector<double> drag;  ///< coefficients relative to A = pi L^2/4
    std::vector<double> moment;
    std::vector<double> k;  ///< k/U^2 near the body; empty where the flow is laminar
    std::vector<double> residual_iterations;
    std::vector<double> residuals;  ///< initial residuals of the pressure in the last round
};

/// Reads the history of a case: force, moment and k at its iterations, in the tables' units, and the
/// residuals of its last round from the solver's log. Where k or the residuals are missing, they stay empty.
/// Throws Error where the forces are missing or damaged.
CaseHistory read_case_history(const std::filesystem::path& folder, const CasePlan& plan,
                              const PlannedCase& planned);

}  // namespace samara
