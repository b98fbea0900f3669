#pragma once

#include "samara/reports/report_program.hpp"

namespace samara {

/// What a folder of solved cases adds to the report of its body: the meshes with checkMesh's verdicts, drawn
/// where the plane of the shortest and longest axis cuts them, y+ of the cases, the histories in which they
/// settled, and the solved free falls beside the runtime's, flown with the body's coefficients. What is not
/// in the folder, or damaged, is told in `missing`. Throws Error where plan.json is damaged or of another
/// body.
CasesReport read_cases_for_report(const std::filesystem::path& folder, const Body& body,
                                  const std::function<void(double share)>& progress);

}  // namespace samara
