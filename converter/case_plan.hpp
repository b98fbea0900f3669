#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "samara/base/linear_algebra.hpp"

namespace samara {

/// What a case is solved for.
enum class CasePurpose {
    table,    ///< its loads go into the table
    mesh,     ///< as some table case, on another mesh: their difference estimates the table's mesh error
    closure,  ///< as some table case, with another closure: their difference estimates the closure's error
    start     ///< only where a case on a finer mesh starts from
};

/// As plan.json words it: table, mesh, closure, start.
std::string name_of(CasePurpose purpose);

/// One OpenFOAM case of a plan. Nondimensional: the body's speed, L and the fluid's density are 1.
struct PlannedCase {
    std::string name;           ///< of its folder
    Vector3d direction;         ///< unit vector: the body's velocity relative to the fluid, case axes
    double reynolds_number;     ///< U L / nu
    std::string mesh = "mesh";  ///< the folder of its mesh, beside its own
    CasePurpose purpose = CasePurpose::table;
    std::string closure;  ///< kEpsilon, realizableKE, laminar, ...; empty: not said
};

/// plan.json of a folder of cases: what `samara bake` set out to solve.
struct CasePlan {
    std::string quality;      ///< smoke, preview, standard or high
    int subdivisions = 1;     ///< of the octahedral map's edges
    double reference_length;  ///< L (m)
    Matrix3d axes;            ///< columns: the case axes, which are the map's, in body axes
    std::vector<PlannedCase> cases;
};

/// Reads FOLDER/plan.json. Throws Error where there is none, where it is no JSON, or where an entry is
/// missing or breaks a rule: axes that are no rotation, directions that are no unit vectors, numbers that are
/// not positive, no cases, two of one name.
CasePlan read_case_plan(const std::filesystem::path& folder);

}  // namespace samara
