#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// The turbulence model that a case was solved with; OpenFOAM has more than those that are distinguished
/// here.
enum class Closure {
    unsaid,  ///< neither the case's plan nor its provenance states it
    laminar,
    k_epsilon,
    realizable_k_epsilon,
    rng_k_epsilon,
    launder_sharma_k_epsilon,
    k_omega,
    k_omega_sst,
    k_omega_sst_lm,
    k_omega_sst_ddes,
    spalart_allmaras,
    other
};

/// Returns OpenFOAM's word for the closure, used in plan.json, fall.json, provenance.json and the case's
/// parameters: kEpsilon, ...; "other" for those that are not distinguished, empty where it is not stated.
std::string_view name_of(Closure closure);

/// Returns the closure with OpenFOAM's word `name`.
Closure closure_of(std::string_view name);

/// Whether the closure solves for omega in place of epsilon.
bool solves_for_omega(Closure closure);

/// The purpose that a case is solved for.
enum class CasePurpose {
    table,    ///< its loads go into the table
    mesh,     ///< on another mesh: its difference from the table case of its flow estimates the table's mesh
              ///< error; where that has no table case, it fills the table between the others
    closure,  ///< like a table case, with another closure: their difference estimates the closure's error
    turbulence,  ///< its k and epsilon go to the case that names it; its loads are not used
    start        ///< only the start of a case on a finer mesh
};

/// Returns the word in plan.json: table, mesh, closure, turbulence, start.
std::string name_of(CasePurpose purpose);

/// Returns the purpose with that word in plan.json; throws Error where there is none.
CasePurpose purpose_of(const std::string& name);

/// The body's scales in the units of a case; all 1 where the case is nondimensional, as those of `samara
/// bake` are.
struct CaseScales {
    double length = 1.0;   ///< L
    double speed = 1.0;    ///< U, of the body relative to the fluid
    double density = 1.0;  ///< of the fluid, as the function object `forces` takes it (rhoInf)
};

/// One OpenFOAM case of a plan.
struct PlannedCase {
    std::string name;           ///< of its folder
    Vector3d direction;         ///< unit vector: the body's velocity relative to the fluid, map axes
    double reynolds_number;     ///< U L / nu
    std::string mesh = "mesh";  ///< the folder of its mesh, beside its own
    CasePurpose purpose = CasePurpose::table;
    Closure closure = Closure::unsaid;
    CaseScales scales = {};
    std::optional<double> averaging_start = {};  ///< start of the averaging window, where the plan states it
    /// The name of the case (purpose turbulence, same flow) from which k and epsilon are taken; empty: this
    /// case's own.
    std::string turbulence_from = {};
};

/// One free fall of a plan (free_fall.hpp).
struct PlannedFall {
    std::string name;           ///< of its folder
    std::string mesh = "mesh";  ///< the folder of its mesh, beside its own
};

/// plan.json of a folder of cases (docs/file-formats): the cases that `samara bake`, or the user, planned.
struct CasePlan {
    std::string quality;   ///< smoke, preview, standard or high; "user" where the user solved the cases and
                           ///< states none
    int subdivisions = 1;  ///< of the octahedral map's edges
    double reference_length;  ///< L (m)
    Matrix3d axes;            ///< columns: the map's axes in body axes
    Matrix3d case_axes;  ///< columns: the axes of the cases in body axes; those of the map for `samara bake`
    bool covers_scene = false;    ///< only the directions that occur in a scene are planned, not all
    bool solved_by_user = false;  ///< the cases need no provenance.json to count as solved
    std::vector<PlannedCase> cases;
    std::vector<PlannedFall> falls;  ///< beside the cases; none where the plan names none

    /// Returns the rotation from case axes to map axes.
    [[nodiscard]] Matrix3d to_map_axes() const { return axes.transpose() * case_axes; }
};

/// Reads FOLDER/plan.json. Where the user solved the cases, quality, reference_length and axes may be absent:
/// the last two are then those of FOLDER/body.body.h5. Throws Error where there is no plan, where a link in
/// the folder leads out of it (require_links_within), where the plan is no JSON, or where an entry is missing
/// or breaks a rule: axes that are no rotation, directions that are no unit vectors, numbers that are not
/// positive, no cases, two cases or falls of one name, two of the same flow and purpose, turbulence from a
/// case that has none or is of another flow.
CasePlan read_case_plan(const std::filesystem::path& folder);

/// Throws Error naming the first entry in or below the folder of cases that is unsafe to read: a link that
/// leads out of it, or an entry that is neither file, folder nor link (a pipe would block its reader). Links
/// within the folder, such as those to meshes, are allowed. Follows no link.
void require_links_within(const std::filesystem::path& folder);

}  // namespace samara
