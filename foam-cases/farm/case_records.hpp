#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "foam-cases/bake/bake_plan.hpp"

namespace samara {

/// The JSON object that a script of a case left behind (failed.json, mesh.json, ...); an empty one where the
/// file is missing or damaged.
nlohmann::json read_record(const std::filesystem::path& file);

/// The text of that name in a record; empty where it has none.
std::string text_in(const nlohmann::json& record, const char* name);

/// The number of that name in a record; 0 where it has none.
double number_in(const nlohmann::json& record, const char* name);

/// CPU seconds that one kind of work took.
struct CpuPart {
    std::string what;       ///< "cases on mesh_coarse", ...
    std::size_t count = 0;  ///< of meshes, cases or falls; 0: not counted
    double seconds = 0.0;
};

/// Where CPU seconds went; no part twice.
using CpuAccount = std::vector<CpuPart>;

/// What the records of a folder of cases say: the meshes, the cases and falls on each, whichever bake solved
/// them.
CpuAccount cpu_account(const std::filesystem::path& folder, const BakePlan& plan);

/// The sum of all parts.
double cpu_seconds_of(const CpuAccount& account);

/// CPU seconds of this process and of all that it has waited for, with theirs.
double cpu_seconds_so_far();

/// A list of objects with "part", "count" and "cpu_seconds"; and a table with the share of each.
nlohmann::json account_as_json(const CpuAccount& account);
std::string account_as_text(const CpuAccount& account);

/// Bytes on the disk that what is planned comes to and is not there yet: meshes without mesh.json, cases and
/// falls without provenance.json in the folder. An estimate, within a factor of two.
double bytes_to_solve(const std::filesystem::path& folder, const BakePlan& plan);

/// Throws Error where the folder's disk has less than half of `bytes` free, before hours are spent on what
/// cannot be written.
void require_room(const std::filesystem::path& folder, double bytes);

}  // namespace samara
