#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>

#include <fmt/format.h>

#include "foam-cases/farm/case_farm.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/folders.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

constexpr const char* note_of_jobs = ".cluster";
// The longest time for a cancelled job to end; Slurm kills it 30 s after the request.
constexpr std::chrono::seconds longest_end(120);
// The longest delay (s) until a file written by a node is visible here, by a network file system.
constexpr const char* file_delay = "60";

// Returns the first word of a command, and the rest.
std::pair<std::string, std::string> first_word(const std::string& command) {
    std::istringstream stream(command);
    std::string word;
    stream >> word;
    std::string rest;
    std::getline(stream >> std::ws, rest);
    return {word, rest};
}

std::string shell_quoted(const std::string& text) {
    std::string quoted = "'";
    for (const char letter : text) quoted += letter == '\'' ? "'\\''" : std::string(1, letter);
    return quoted + "'";
}

// Returns the output of a command of Slurm; throws Error with its last line where it fails.
std::string output_of(const std::vector<std::string>& words) {
    const TemporaryFolder temporary;
    const fs::path output = temporary.path() / "output";
    const int status = run_subprocess(words, output);
    std::string text = read_bytes(output);
    if (status == 0) return text;
    while (text.ends_with('\n')) text.pop_back();
    throw Error(fmt::format("{} failed: {}", words.front(), text.substr(text.rfind('\n') + 1)));
}

}  // namespace

void require_sbatch(const std::string& command) {
    if (fs::path(first_word(command).first).filename() == "sbatch") return;
    throw Error(
        fmt::format("--cluster \"{}\": only Slurm's sbatch is supported, as in --cluster \"sbatch "
                    "--time=30\"; for another scheduler run the Snakefile by hand with a profile for it",
                    command));
}

void require_slurm() {
    try {
        output_of({"squeue", "--noheader", "--name=samara"});
    } catch (const Error& error) {
        throw Error(fmt::format(
            "--cluster: Slurm does not respond ({}); run on a machine of the cluster, or set SLURM_CONF",
            error.what()));
    }
}

std::string job_name(const fs::path& folder) {
    return "samara-" + content_hash(fs::weakly_canonical(folder).string()).substr(0, 12);
}

std::vector<std::string> cluster_words(const fs::path& folder, const FarmOptions& options,
                                       const fs::path& foam_cases) {
    std::ofstream(folder / note_of_jobs) << job_name(folder) << '\n';
    const auto [sbatch, rest] = first_word(options.cluster);
    const std::string submit = fmt::format(
        "{} --parsable --job-name={} --output={{params.folder}}/{} --cpus-per-task={{threads}} {}", sbatch,
        job_name(folder), job_log, rest);
    return {"--cluster",        submit,
            "--cluster-status", shell_quoted((foam_cases / "farm/slurm/job_state.py").string()),
            "--cluster-cancel", "scancel",
            "--latency-wait",   file_delay,
            "--jobs",           std::to_string(options.jobs)};
}

void end_earlier_jobs(const fs::path& folder) {
    if (!fs::exists(folder / note_of_jobs)) return;
    const std::string name = "--name=" + job_name(folder);
    output_of({"scancel", name});
    const auto start = std::chrono::steady_clock::now();
    while (!output_of({"squeue", "--noheader", name}).empty()) {
        if (std::chrono::steady_clock::now() - start > longest_end) {
            throw Error(fmt::format("{}: jobs of an earlier bake still run on the cluster; see squeue {}",
                                    folder.string(), name));
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
    }
    fs::remove(folder / note_of_jobs);
}

}  // namespace samara
