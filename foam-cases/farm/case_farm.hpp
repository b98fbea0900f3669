#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "foam-cases/bake/bake_plan.hpp"
#include "samara/analysis/verdicts/case_records.hpp"

namespace samara {

/// Where and how cases are solved.
struct FarmOptions {
    int jobs = 1;         ///< number of cases at once
    std::string cluster;  ///< the command that submits a job to Slurm, "sbatch ..."; empty: on this machine
    std::string work = "baking";  ///< the work, as named in progress and errors
};

/// Throws Error naming every program that solving needs and that is not on PATH, with the Debian packages
/// that contain them; on a cluster OpenFOAM is needed only on its nodes. `ranks`: the plan's.
void require_solvers(const FarmOptions& options, int ranks);

/// Returns the number of planned cases that are solved.
std::size_t count_solved(const std::filesystem::path& folder, const BakePlan& plan);

/// Solves the cases of a folder written by write_case_folder that are not solved yet, with
/// Snakemake; the others continue where a case fails. Progress is printed on standard error. Returns the
/// cases that failed (they have a failed.json, or their mesh has), where others are solved. Throws Error
/// where no case could be solved, where one is neither solved nor failed because a program was killed or the
/// disk is full (naming the first, its log, and how many), and where the user interrupted it. Solved cases
/// are kept: the next call continues from there.
std::vector<LeftOutCase> solve_cases(const std::filesystem::path& folder, const BakePlan& plan,
                                     const FarmOptions& options, const std::filesystem::path& foam_cases);

/// Throws Error where the command that submits jobs is not one of Slurm's sbatch.
void require_sbatch(const std::string& command);

/// Throws Error where no Slurm answers.
void require_slurm();

/// Returns the options of Snakemake that submit the cases of a folder to a Slurm cluster: each job has the
/// name of the folder's jobs, writes log.slurm in the folder of its mesh or case, and is polled for its
/// state, so that a job that was killed or ran out of time is detected. Writes a file into the folder which
/// marks that jobs may run.
std::vector<std::string> cluster_words(const std::filesystem::path& folder, const FarmOptions& options,
                                       const std::filesystem::path& foam_cases);

/// Returns the name of all jobs of a folder of cases on the cluster, by the folder's path.
std::string job_name(const std::filesystem::path& folder);

/// Cancels the jobs of the folder that still run on a cluster, as after an interruption, and waits for their
/// end, since two solvers would corrupt a case. Does nothing where no jobs were submitted. Throws Error where
/// Slurm does not answer or the jobs do not end.
void end_earlier_jobs(const std::filesystem::path& folder);

/// The log of a cluster's job in the folder of its mesh or case.
inline constexpr const char* job_log = "log.slurm";

}  // namespace samara
