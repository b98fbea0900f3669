#pragma once

#include <filesystem>
#include <vector>

#include "converter/cases/case_mesh.hpp"
#include "converter/cases/case_plan.hpp"
#include "samara/core/body/body.hpp"
#include "samara/reports/report_blocks.hpp"

namespace samara {

/// A mesh that cases of the plan were solved on.
struct SolvedMesh {
    std::string name;
    nlohmann::json record;  ///< mesh.json
    PolyMesh mesh;
    std::vector<WallSpacing> spacings = {};  ///< of the cases that tables are made of
};

/// Returns the part of a report by which an engineer judges how the cases of a folder were solved: domain and
/// blockage, closures, averaging window, residuals, y+, the drag over each direction's meshes with its
/// observed order, and what such a flow cannot hold. `meshes`: coarsest first. Figures that the folder lacks
/// are left out.
ReportPart part_of_flow(const std::filesystem::path& folder, const CasePlan& plan, const Body& body,
                        const std::vector<SolvedMesh>& meshes);

}  // namespace samara
