#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "foam-cases/bake/bake_plan.hpp"

namespace samara {

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

}  // namespace samara
