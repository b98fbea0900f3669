#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "converter/case_plan.hpp"
#include "converter/symmetric_loads.hpp"

namespace samara {

/// What one solved OpenFOAM case gives to the tables, in case axes.
struct SolvedCase {
    std::string name;
    double reynolds_number;
    DirectionSample sample;
    std::string provenance;  ///< the JSON object of its provenance.json
    std::string mesh = "mesh";
    CasePurpose purpose = CasePurpose::table;
    std::string closure;  ///< empty: not said
};

/// Whether the case was solved and checked: it has a provenance.json.
bool is_solved(const std::filesystem::path& folder);

/// The cells of the shell of fluid from 0.05 L to 0.25 L of the body: the cell zone `shell` of
/// FOLDER/constant/polyMesh, in the folder of a case or of the mesh that cases share.
std::vector<std::int64_t> shell_cells(const std::filesystem::path& folder);

/// Reduces a solved case:
///  - force and moment coefficients: means of postProcessing/forces over the iterations from averagingStart
///    (in its `parameters`) on, over A/2 = pi/8, for the case's units are U = L = rho = 1;
///  - k and epsilon: volume means of kMean and epsilonMean of the last written iteration over `shell`, with
///    the written cell volumes V;
///  - errors: standard_error of the same iterations; for k and epsilon of postProcessing/shell.
/// Throws Error naming the case where a file is missing or damaged, where the case was solved for another
/// direction or Reynolds number than planned, where the means of the histories and of the fields differ (they
/// are of different runs), or where the solution diverged: values that are not finite, drag, k or epsilon not
/// positive.
SolvedCase reduce_case(const std::filesystem::path& folder, const PlannedCase& planned,
                       const std::vector<std::int64_t>& shell);

}  // namespace samara
