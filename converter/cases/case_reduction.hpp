#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "converter/cases/case_plan.hpp"
#include "converter/cases/turbulence_means.hpp"
#include "converter/tables/symmetric_loads.hpp"
#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/core/body/body.hpp"

namespace samara {

/// The data that one solved OpenFOAM case gives to the tables, in map axes.
struct SolvedCase {
    std::string name;
    double reynolds_number;
    DirectionSample sample;
    std::string
        provenance;  ///< the JSON object of its provenance.json; of a user's case {"solved_by": "user"}
    std::string mesh = "mesh";
    CasePurpose purpose = CasePurpose::table;
    Closure closure = Closure::unsaid;                   ///< as the case was solved
    std::optional<TurbulenceMean> turbulence_mean = {};  ///< none where the flow is laminar
};

/// Whether the case was solved and checked: it has a provenance.json. A case of a plan that says "solved_by":
/// "user" counts as solved without.
bool is_solved(const std::filesystem::path& folder);

/// Reduces the solved case FOLDER/NAME of a plan, over all rounds of its solution:
///  - force and moment coefficients: means of postProcessing/forces over the times from averaging_start on,
///    divided by rho U^2 A/2 with A = pi L^2/4, and for the moment also by L;
///  - k/U^2 and epsilon L/U^3: means over the same times of those near the body (read_turbulence_history); 0
///  where
///    the closure is laminar; those of another case where the plan says so (turbulence_from), whose
///    provenance then stands in this one's as `turbulence`;
///  - errors: tail_error of the same times.
/// averaging_start is the plan's for this case, else that of provenance.json, else the start of the last
/// quarter of the times. Those of k and epsilon are compared with the fields written last (written_means),
/// and all means with those in provenance.json. Throws Error naming case or file where a file is missing or
/// damaged; where the case was solved for another direction or Reynolds number than planned, by its
/// parameters or by the viscosity, velocity, density and, of a user's case, body area that its own files set
/// up (CaseSetup); where histories are not whole or plausible (require_whole, require_plausible), have
/// changed since the case was solved, or differ from the fields by more than 1e-4 (they are of different
/// runs); and where the solution diverged: values that are not finite, drag, k or epsilon not positive.
SolvedCase reduce_case(const std::filesystem::path& folder, const CasePlan& plan, const PlannedCase& planned,
                       MeshZones& zones);

/// The reduced cases of a folder.
struct FolderReduction {
    std::vector<SolvedCase>
        cases;  ///< in the plan's order, map axes; of all purposes but turbulence and start
    std::vector<LeftOutCase> left_out;  ///< failed or unsolved cases of the same purposes
};

/// Whether cases that are neither solved nor failed are an error or are left out.
enum class UnsolvedCases { reject, leave_out };

/// Reduces every case of the plan (reduce_case), each with the cell zone of the mesh FOLDER/MESH that it
/// names, or of its own constant/polyMesh where there is no such folder; a mesh is read once. A case with
/// failed.json, or whose mesh has one, is left out with the reason there, and so is one that takes its
/// turbulence from a failed case. `progress` is called with the number of cases done and their total. Throws
/// Error where a case is damaged, and, unless `unsolved` says otherwise, where a case is neither solved nor
/// failed (the message names the first).
FolderReduction reduce_folder(const std::filesystem::path& folder, const CasePlan& plan,
                              const std::function<void(std::size_t done, std::size_t total)>& progress = {},
                              UnsolvedCases unsolved = UnsolvedCases::reject);

/// Returns why the case or fall FOLDER/NAME failed, by its failed.json or that of FOLDER/MESH; nothing where
/// neither exists, or it was solved after all. Throws Error where that file is damaged.
std::optional<std::string> failure_of(const std::filesystem::path& folder, const std::string& name,
                                      const std::string& mesh);

/// Returns the Reynolds number of which the plan has most cases on the last mesh and the one before it
/// (purposes `table` and `mesh`), solved or not; the lowest of equals. Throws Error where no case is for the
/// table.
double main_reynolds_number(const CasePlan& plan);

/// Throws Error where too few of the plan's cases are solved for useful tables. The main Reynolds number must
/// plan at least the required_directions of a map with one subdivision, unless the plan covers a scene alone,
/// and at most one in five of its directions may be left out.
void require_enough_directions(const CasePlan& plan, const Symmetry& symmetry,
                               const FolderReduction& reduction);

}  // namespace samara
