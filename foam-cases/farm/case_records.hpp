#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "foam-cases/bake/bake_plan.hpp"

namespace samara {

/// Reads the JSON object that a script of a case wrote (failed.json, mesh.json, ...); returns an empty one
/// where the file is missing or damaged.
nlohmann::json read_record(const std::filesystem::path& file);

/// Returns the text of that name in a record; empty where it has none.
std::string text_in(const nlohmann::json& record, const char* name);

/// Returns the number of that name in a record; 0 where it has none.
double number_in(const nlohmann::json& record, const char* name);

/// The CPU seconds of one part of the work.
struct CpuPart {
    std::string what;       ///< "cases on mesh_coarse", ...
    std::size_t count = 0;  ///< number of meshes, cases or falls; 0: not counted
    double seconds = 0.0;
};

/// The CPU seconds by part of the work, without overlap.
using CpuAccount = std::vector<CpuPart>;

/// Returns the CPU seconds by the records of a folder of cases: of the meshes, and of the cases and falls on
/// each, by any bake.
CpuAccount cpu_account(const std::filesystem::path& folder, const BakePlan& plan);

/// Returns the sum of all parts.
double cpu_seconds_of(const CpuAccount& account);

/// Returns the CPU seconds of this process and its finished child processes.
double cpu_seconds_so_far();

/// Return the account as a JSON list of objects with "part", "count" and "cpu_seconds", and as a text table
/// with the share of each.
nlohmann::json account_as_json(const CpuAccount& account);
std::string account_as_text(const CpuAccount& account);

/// Estimates the bytes on the disk that the unsolved part of a plan needs, within a factor of two: meshes
/// without mesh.json, cases and falls without provenance.json in the folder.
double bytes_to_solve(const std::filesystem::path& folder, const BakePlan& plan);

/// Throws Error where the folder's disk has less than half of `bytes` free, before hours of work that cannot
/// be written.
void require_room(const std::filesystem::path& folder, double bytes);

}  // namespace samara
