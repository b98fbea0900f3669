#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "foam-cases/bake/bake_plan.hpp"
#include "samara/analysis/verdicts/case_records.hpp"

namespace samara {

/// Where and how cases are solved.
struct FarmOptions {
    int jobs = 1;         ///< cases at once
    std::string cluster;  ///< the command that submits a job to Slurm, "sbatch ..."; empty: on this machine
    std::string work = "baking";  ///< what is done, as progress and faults call it
};

/// Throws Error naming every program that solving needs and that is not on PATH, with the Debian packages
/// that bring them: on a cluster OpenFOAM need be on its nodes alone; `ranks` is of the plan.
void require_solvers(const FarmOptions& options, int ranks);

/// How many of the planned cases are solved.
std::size_t count_solved(const std::filesystem::path& folder, const BakePlan& plan);

/// Solves the cases of a folder written by write_case_folder that are not solved yet, with
/// Snakemake; a case that fails leaves the others running. Progress goes to standard error. Returns the cases
/// that failed (they have a failed.json, or their mesh has) while others are solved. Throws Error where no
/// case could be solved, where one is neither solved nor failed because a program was killed or the disk is
/// full (naming the first, its log, and how many), and where the user interrupted it. Solved cases stay: the
/// next call goes on from there.
std::vector<LeftOutCase> solve_cases(const std::filesystem::path& folder, const BakePlan& plan,
                                     const FarmOptions& options, const std::filesystem::path& foam_cases);

}  // namespace samara
