#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/body/load_tables.hpp"

namespace samara {

/// Record in a body file of one solved case of its tables.
struct CaseRecord {
    std::string name;
    std::string purpose;          ///< "table", "mesh", "closure", as plan.json words it
    Vector3d direction;           ///< unit vector: the body's velocity relative to the fluid, body axes
    double reynolds_number;       ///< U L / nu
    double drag;                  ///< coefficient on A = pi L^2/4
    std::optional<double> k;      ///< k / U^2 near the body; none of a laminar case
    double cells = 0.0;           ///< number of cells of its mesh; 0 where it is unknown
    std::string closure;          ///< OpenFOAM's word
    std::string verdict;          ///< "stationary", "restless"
    std::string mesh_verdict;     ///< checkMesh's, "ok" or what is wrong
    std::string mesh_remedy;      ///< change that made the mesh good; "as planned" where none was needed
    std::string openfoam;         ///< version
    double cpu_seconds = 0.0;     ///< CPU time of the solver
    double final_residual = 0.0;  ///< residual of the pressure in the last iteration; 0 where it is unknown
};

/// The distance between unit vectors below which two cases are of one direction: those of one plan differ by
/// the rounding of a rotation of axes alone.
inline constexpr double same_direction = 1e-6;

/// Returns the means of k and epsilon of a case's provenance.json, by its keys `k` and `epsilon`: over the
/// near wake, or over the shell of earlier cases; nothing where it has neither.
const nlohmann::json* turbulence_means(const nlohmann::json& provenance);

/// Returns whether the case is on the last mesh or the one before it (purposes "table" and "mesh").
bool is_on_last_meshes(const CaseRecord& record);

/// Reads the records of the tables' cases that say in which flow they were solved, in the file's order; none
/// where the provenance is not that of `samara bake`.
std::vector<CaseRecord> case_records(const LoadTables& tables);

/// Returns the Reynolds number at which the most cases are on the last meshes; without records the highest.
double main_reynolds_number(const LoadTables& tables, const std::vector<CaseRecord>& records);

/// A case that was planned but could not be solved: its direction is filled from the others.
struct LeftOutCase {
    std::string name;    ///< name of the case's folder
    std::string reason;  ///< one line
};

/// Returns the text of these cases for LoadTables::left_out: a JSON list of their names and reasons; empty
/// without cases.
std::string left_out_text(const std::vector<LeftOutCase>& cases);

/// Reads the cases that could not be solved. Throws Error where LoadTables::left_out is no such list.
std::vector<LeftOutCase> left_out_cases(const LoadTables& tables);

}  // namespace samara
