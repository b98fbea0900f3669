#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "converter/cases/closure.hpp"
#include "samara/core/base/linear_algebra.hpp"

namespace samara {

/// What a case is solved for.
enum class CasePurpose {
    table,    ///< its loads go into the table
    mesh,     ///< on another mesh: its difference from the table case of its flow estimates the table's mesh
              ///< error; where there is none, it fills the table between those that there are
    closure,  ///< as some table case, with another closure: their difference estimates the closure's error
    turbulence,  ///< its k and epsilon go to the case that names it; its loads are not used
    start        ///< only where a case on a finer mesh starts from
};

/// As plan.json words it: table, mesh, closure, turbulence, start.
std::string name_of(CasePurpose purpose);

/// The purpose of that name; throws Error where there is none.
CasePurpose purpose_of(const std::string& name);

/// The body's scales in the units of a case; 1 where it is nondimensional, as those of `samara bake` are.
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
    std::optional<double> averaging_start = {};  ///< the first time that counts, where the plan says
    /// The case of purpose turbulence, of the same flow, that this one's k and epsilon are taken from; empty:
    /// its own.
    std::string turbulence_from = {};
};

/// One free fall of a plan (free_fall.hpp).
struct PlannedFall {
    std::string name;           ///< of its folder
    std::string mesh = "mesh";  ///< the folder of its mesh, beside its own
};

/// plan.json of a folder of cases (docs/file-formats): what `samara bake`, or the user, set out to solve.
struct CasePlan {
    std::string quality;   ///< smoke, preview, standard or high; "user" where the user solved and says none
    int subdivisions = 1;  ///< of the octahedral map's edges
    double reference_length;  ///< L (m)
    Matrix3d axes;            ///< columns: the map's axes in body axes
    Matrix3d case_axes;  ///< columns: the axes of the cases in body axes; those of the map for `samara bake`
    bool covers_scene = false;    ///< the directions are those that a scene visits, not all
    bool solved_by_user = false;  ///< the cases need no provenance.json to count as solved
    std::vector<PlannedCase> cases;
    std::vector<PlannedFall> falls;  ///< beside the cases; none where the plan names none

    /// Turns vectors in case axes into map axes.
    [[nodiscard]] Matrix3d to_map_axes() const { return axes.transpose() * case_axes; }
};

/// Reads FOLDER/plan.json. Where the user solved the cases, quality, reference_length and axes may be absent:
/// the last two are then those of FOLDER/body.body.h5. Throws Error where there is no plan, where a link in
/// the folder leads out of it (case_links.hpp), where the plan is no JSON, or where an entry is missing or
/// breaks a rule: axes that are no rotation, directions that are no unit vectors, numbers that are not
/// positive, no cases, two cases or falls of one name, two of the same flow and purpose, turbulence from a
/// case that has none or is of another flow.
CasePlan read_case_plan(const std::filesystem::path& folder);

/// Throws Error naming the first thing in the folder of cases, or below it, that reading would lead astray: a
/// link out of it, or what is neither a file, a folder nor a link (a pipe would keep its reader waiting).
/// Links within it, as those to meshes are, are as they should be. Follows none.
void require_links_within(const std::filesystem::path& folder);

}  // namespace samara
