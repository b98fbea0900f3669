#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace samara {

struct FarmOptions;

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
