#pragma once

#include <filesystem>
#include <string>

#include "converter/cases/case_plan.hpp"
#include "converter/cases/shell_means.hpp"
#include "converter/tables/symmetric_loads.hpp"

namespace samara {

/// What one solved OpenFOAM case gives to the tables, in map axes.
struct SolvedCase {
    std::string name;
    double reynolds_number;
    DirectionSample sample;
    std::string
        provenance;  ///< the JSON object of its provenance.json; of a user's case {"solved_by": "user"}
    std::string mesh = "mesh";
    CasePurpose purpose = CasePurpose::table;
    Closure closure = Closure::unsaid;  ///< as the case was solved
};

/// Whether the case was solved and checked: it has a provenance.json. A case of a plan that says "solved_by":
/// "user" counts as solved without.
bool is_solved(const std::filesystem::path& folder);

/// Reduces the solved case FOLDER/NAME of a plan, over all rounds of its solution:
///  - force and moment coefficients: means of postProcessing/forces over the times from averaging_start on,
///    over rho U^2 A/2 with A = pi L^2/4, and for the moment also over L;
///  - k/U^2 and epsilon L/U^3: means over the same times of the volume means in postProcessing/shell; 0 where
///    the closure is laminar; those of another case where the plan says so (turbulence_from), whose
///    provenance then stands in this one's as `turbulence`;
///  - errors: tail_error of the same times.
/// averaging_start is the plan's for this case, else that of provenance.json, else the start of the last
/// quarter of the times. The volume means are held against the fields written last (mean_over_shell), and all
/// means against those that provenance.json noted when the case was solved. Throws Error naming case or file
/// where a file is missing or damaged, where the case was solved for another direction or Reynolds number
/// than planned, by its parameters or by the viscosity, velocity, density and, of a user's case, body area
/// that its own files set up (case_setup.hpp), where histories are not whole or plausible
/// (quantity_history.hpp), have changed since the case was solved, or differ from the fields by more than
/// 1e-4 (they are of different runs), or where the solution diverged: values that are not finite, drag, k or
/// epsilon not positive.
SolvedCase reduce_case(const std::filesystem::path& folder, const CasePlan& plan, const PlannedCase& planned,
                       Shells& shells);

}  // namespace samara
