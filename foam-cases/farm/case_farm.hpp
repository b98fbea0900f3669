#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "foam-cases/bake/bake_plan.hpp"
#include "samara/formats/left_out_cases.hpp"

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

/// Throws Error where the command that submits jobs is not one of Slurm's sbatch.
void require_sbatch(const std::string& command);

/// Throws Error where no Slurm answers.
void require_slurm();

/// The words for Snakemake that send the cases of a folder to a Slurm cluster: each job has the name of the
/// folder's jobs, writes log.slurm in the folder of its mesh or case, and is asked for its state, so that one
/// that was killed or ran out of time is noticed. A note in the folder says that jobs may run.
std::vector<std::string> cluster_words(const std::filesystem::path& folder, const FarmOptions& options,
                                       const std::filesystem::path& foam_cases);

/// The name that all jobs of a folder of cases have on the cluster: of the folder's path.
std::string job_name(const std::filesystem::path& folder);

/// Cancels the jobs of the folder that still run on a cluster, as after an interruption or where an earlier
/// bake was killed, and waits for their end: two solvers at work in one case would spoil it. Does nothing
/// where no bake sent any. Throws Error where Slurm does not answer or the jobs do not end.
void end_earlier_jobs(const std::filesystem::path& folder);

/// What a cluster's job wrote, in the folder of its mesh or case.
inline constexpr const char* job_log = "log.slurm";

}  // namespace samara
