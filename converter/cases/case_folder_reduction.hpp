#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "converter/cases/case_plan.hpp"
#include "converter/cases/case_reduction.hpp"
#include "samara/analysis/verdicts/case_records.hpp"
#include "samara/core/body/body.hpp"

namespace samara {

/// What the cases of a folder give.
struct FolderReduction {
    std::vector<SolvedCase>
        cases;  ///< in the plan's order, map axes; of every purpose but turbulence and start
    std::vector<LeftOutCase> left_out;  ///< of the same
};

/// What becomes of cases that are neither solved nor failed.
enum class UnsolvedCases { reject, leave_out };

/// Reduces every case of the plan (reduce_case), each with the shell of the mesh FOLDER/MESH that it names,
/// or of its own constant/polyMesh where there is no such folder; a mesh is read once. A case
/// with failed.json, or whose mesh has one, is left out with the reason that stands there, and so is one
/// whose turbulence is another's that failed. `progress` is told how many cases of how many are done. Throws
/// Error where a case is damaged, and, unless `unsolved` says otherwise, where a case is neither solved nor
/// failed (the message names the first).
FolderReduction reduce_folder(const std::filesystem::path& folder, const CasePlan& plan,
                              const std::function<void(std::size_t done, std::size_t total)>& progress = {},
                              UnsolvedCases unsolved = UnsolvedCases::reject);

/// Why the case or fall FOLDER/NAME failed, by its failed.json or that of FOLDER/MESH; nothing where neither
/// is there, or it was solved after all. Throws Error where that file is damaged.
std::optional<std::string> failure_of(const std::filesystem::path& folder, const std::string& name,
                                      const std::string& mesh);

/// That of which the plan has most cases on the last mesh and the one before it (purposes `table` and
/// `mesh`), the lowest of equals, whatever became of them. Throws Error where no case is for the table.
double main_reynolds_number(const CasePlan& plan);

/// Throws Error where the plan's cases cannot make tables that are worth it. The main Reynolds number must
/// plan at least the required_directions of a map with one subdivision, unless the plan covers a scene alone,
/// and at most one in five of its directions may be left out.
void require_enough_directions(const CasePlan& plan, const Symmetry& symmetry,
                               const FolderReduction& reduction);

}  // namespace samara
