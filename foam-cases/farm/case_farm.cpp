#include "foam-cases/farm/case_farm.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "converter/cases/case_reduction.hpp"
#include "foam-cases/falls/fall_plan.hpp"
#include "foam-cases/farm/case_records.hpp"
#include "foam-cases/farm/guarded_process.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/folders.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

constexpr const char* mesh_record = "mesh.json";
constexpr const char* failure_record = "failed.json";
constexpr std::uintmax_t room_of_a_log = 65'536;  // bytes; with less space a disk counts as full
constexpr const char* check_log = "log.check";    // log of a check, with its result in the last line

// A case or a fall to be solved.
struct Job {
    std::string name;
    std::string mesh;
    std::string start_from;
    double end;      // final iteration (an estimate) or time
    double seconds;  // estimated CPU seconds
};

std::vector<Job> jobs_of(const BakePlan& plan) {
    std::vector<Job> jobs;
    for (const BakeCase& entry : plan.cases) {
        jobs.push_back({entry.name, entry.mesh, entry.start_from, estimated_iterations(plan, entry),
                        estimated_seconds(plan, entry)});
    }
    for (const FreeFall& fall : plan.falls) {
        jobs.push_back({fall.name, fall.mesh, "", fall.duration,
                        estimated_fall_seconds(fall, cells_of(plan, fall.mesh))});
    }
    return jobs;
}

// Returns the last line that contains the text; empty where there is none.
std::string last_line(const fs::path& file, const std::string& text = "") {
    if (!fs::exists(file)) return {};
    std::istringstream lines(read_bytes(file));
    std::string last;
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty() && line.find(text) != std::string::npos) last = line;
    }
    return last;
}

// Replaces paths relative to the folder of cases, as its scripts print them, by paths relative to the working
// folder.
std::string with_paths_from_here(std::string line, const fs::path& folder, const std::string& name) {
    const std::string inside = " " + name + "/";
    const std::string outside = fmt::format(" {}/{}/", folder.string(), name);
    for (std::size_t at = line.find(inside); at != std::string::npos;
         at = line.find(inside, at + outside.size())) {
        line.replace(at, inside.size(), outside);
    }
    return line;
}

// Returns the error of a mesh or case: the line that its script or its cluster job printed.
std::string error_of(const fs::path& folder, const std::string& name, bool on_cluster) {
    const std::string line = last_line(folder / name / check_log);
    if (line.starts_with(name + ": ")) {
        return fmt::format("{}/{}", folder.string(), with_paths_from_here(line, folder, name));
    }
    const std::string of_job = last_line(folder / name / job_log, "slurmstepd");
    if (!of_job.empty()) {
        return fmt::format("{}: its cluster job ended early: {}; see {}", (folder / name).string(), of_job,
                           (folder / name / job_log).string());
    }
    if (on_cluster && line.empty() && !fs::exists(folder / name / job_log)) {
        return fmt::format("{}: its cluster job wrote nothing there; use a folder that the nodes share",
                           (folder / name).string());
    }
    std::error_code unknown;
    if (fs::space(folder, unknown).available < room_of_a_log && !unknown) {
        return fmt::format("{}: did not finish: the disk is full; free some space and run again",
                           (folder / name).string());
    }
    return fmt::format("{}: did not finish; see {}", (folder / name).string(),
                       (folder / "log.snakemake").string());
}

// Returns why the mesh or case is left out; nothing where it is not.
std::optional<std::string> failure_of(const fs::path& folder, const std::string& name) {
    const fs::path record = folder / name / failure_record;
    if (!fs::exists(record)) return std::nullopt;
    const std::string reason = text_in(read_record(record), "reason");
    if (reason.empty()) return fmt::format("failed; see {}", (folder / name / check_log).string());
    return with_paths_from_here(reason, folder, name);
}

std::vector<LeftOutCase> left_out_cases(const fs::path& folder, const BakePlan& plan) {
    std::vector<LeftOutCase> left_out;
    for (const Job& entry : jobs_of(plan)) {
        if (is_solved(folder / entry.name)) continue;
        if (const auto reason = failure_of(folder, entry.name)) {
            left_out.push_back({entry.name, *reason});
        } else if (const auto of_mesh = failure_of(folder, entry.mesh)) {
            left_out.push_back({entry.name, fmt::format("its mesh {} failed: {}", entry.mesh, *of_mesh)});
        }
    }
    return left_out;
}

bool is_settled(const fs::path& folder, const Job& entry) {
    return is_solved(folder / entry.name) || fs::exists(folder / entry.name / failure_record) ||
           fs::exists(folder / entry.mesh / failure_record);
}

// Throws Error about cases that are neither solved nor left out, or about all being left out: with the error
// of the first case, unfinished cases before failed ones.
[[noreturn]] void report_failure(const fs::path& folder, const BakePlan& plan, bool on_cluster) {
    const std::vector<Job> jobs = jobs_of(plan);
    std::vector<const Job*> failed;
    for (const Job& entry : jobs) {
        if (!is_solved(folder / entry.name)) failed.push_back(&entry);
    }
    if (failed.empty()) {
        throw Error(fmt::format("snakemake failed; see {}", (folder / "log.snakemake").string()));
    }
    const auto rank = [&](const Job* entry) {
        return std::pair(is_settled(folder, *entry), !fs::exists(folder / entry->name / check_log));
    };
    const Job& first = **std::ranges::min_element(failed, std::less<>(), rank);
    if (!fs::exists(folder / first.mesh / mesh_record)) throw Error(error_of(folder, first.mesh, on_cluster));
    if (plan.type == CaseType::fall) throw Error(error_of(folder, first.name, on_cluster));
    throw Error(fmt::format("{} ({} of {} cases failed; the solved ones are kept for the next run)",
                            error_of(folder, first.name, on_cluster), failed.size(), jobs.size()));
}

// Returns the iteration or time of the last line of the last round's history of forces; 0 where there is
// none.
double last_iteration(const fs::path& case_folder) {
    double last_round = -1.0;
    fs::path history;
    std::error_code none;
    for (const auto& round : fs::directory_iterator(case_folder / "postProcessing/forces", none)) {
        const double start = std::strtod(round.path().filename().c_str(), nullptr);
        if (start <= last_round) continue;
        last_round = start;
        history = round.path() / "force.dat";
    }
    std::ifstream file(history, std::ios::binary | std::ios::ate);
    if (!file) return std::max(0.0, last_round);
    constexpr std::streamoff more_than_a_line = 1024;
    file.seekg(std::max<std::streamoff>(0, file.tellg() - more_than_a_line));
    double last = std::max(0.0, last_round);
    // The first line may be incomplete; a line without its end is still being written.
    for (std::string line; std::getline(file, line) && !file.eof();) {
        if (!line.starts_with('#')) last = std::strtod(line.c_str(), nullptr);
    }
    return last;
}

// Returns the progress of a case, 0 to 1, relative to its final iteration or time.
double solved_share(const fs::path& case_folder, double end) {
    if (is_solved(case_folder) || fs::exists(case_folder / failure_record)) return 1.0;
    return std::min(1.0, last_iteration(case_folder) / end);
}

std::vector<Job> unsettled(const fs::path& folder, const BakePlan& plan) {
    std::vector<Job> jobs = jobs_of(plan);
    std::erase_if(jobs, [&](const Job& entry) { return is_settled(folder, entry); });
    return jobs;
}

bool waits_for_failed_start(const fs::path& folder, const BakePlan& plan) {
    const std::vector<Job> jobs = jobs_of(plan);
    return std::ranges::any_of(unsettled(folder, plan), [&](const Job& entry) {
        const auto start = std::ranges::find(jobs, entry.start_from, &Job::name);
        return start != jobs.end() && !is_solved(folder / start->name) && is_settled(folder, *start);
    });
}

// Returns PYTHONPATH without its relative folders, by which Python would load modules from the folder of
// cases.
std::string absolute_python_path() {
    const char* given = std::getenv("PYTHONPATH");
    std::istringstream folders(given == nullptr ? "" : given);
    std::string absolute;
    for (std::string folder; std::getline(folders, folder, ':');) {
        if (fs::path(folder).is_absolute()) absolute += (absolute.empty() ? "" : ":") + folder;
    }
    return "PYTHONPATH=" + absolute;
}

// Runs Snakemake over the cases that are not settled, to its end. Throws Error on an interruption.
void run_snakemake(const fs::path& folder, const BakePlan& plan, const FarmOptions& options,
                   const fs::path& foam_cases) {
    const std::vector<Job> to_solve = unsettled(folder, plan);
    const bool counts_steps = plan.type == CaseType::fall;
    double all = counts_steps ? 0.0 : static_cast<double>(to_solve.size());
    if (counts_steps) {
        for (const FreeFall& fall : plan.falls) all += fall.duration / fall.time_step;
    }
    Progress progress(options.work, counts_steps ? "steps" : "cases");
    const auto tick = [&, last = std::chrono::steady_clock::time_point()]() mutable {
        const auto now = std::chrono::steady_clock::now();
        if (now - last < std::chrono::seconds(1)) return;
        last = now;
        double done = 0.0;
        double total = 0.0;
        for (const Job& entry : to_solve) {
            done += entry.seconds * solved_share(folder / entry.name, entry.end);
            total += entry.seconds;
        }
        progress.update(all * done / total, all);
    };
    // Paths are absolute, since a relative one may begin with a dash. Snakemake's notes of an earlier run are
    // not needed, and those in a folder of another origin are not trusted.
    fs::remove_all(folder / ".snakemake");
    std::vector<std::string> words = {"env",
                                      "PYTHONSAFEPATH=1",
                                      absolute_python_path(),
                                      "snakemake",
                                      "--snakefile",
                                      fs::absolute(foam_cases / "farm/Snakefile").string(),
                                      "--directory",
                                      fs::absolute(folder).string(),
                                      "--keep-going",
                                      "--nolock",
                                      "--ignore-incomplete",
                                      "--rerun-triggers",
                                      "mtime",
                                      "--quiet",
                                      "all"};
    const std::vector<std::string> where =
        options.cluster.empty()
            ? std::vector<std::string>{"--cores", std::to_string(options.jobs * plan.ranks)}
            : cluster_words(folder, options, foam_cases);
    words.insert(words.end(), where.begin(), where.end());
    const auto status = run_guarded(words, folder / "log.snakemake", fs::current_path(), tick);
    end_earlier_jobs(folder);
    if (status) return;
    if (plan.type == CaseType::fall) {
        throw Error(
            fmt::format("interrupted: solved cases are kept in {}; run the same command again to continue",
                        folder.string()));
    }
    throw Error(fmt::format(
        "interrupted: {} of {} cases are solved and kept in {}; run the same command again to continue",
        count_solved(folder, plan), jobs_of(plan).size(), folder.string()));
}

}  // namespace

std::size_t count_solved(const fs::path& folder, const BakePlan& plan) {
    return static_cast<std::size_t>(std::ranges::count_if(
        jobs_of(plan), [&](const Job& entry) { return is_solved(folder / entry.name); }));
}

namespace {

// Returns the words before each of OpenFOAM's programs that run it in a container.
std::vector<std::string> words_of_container() {
    const char* given = std::getenv("SAMARA_OPENFOAM");
    std::istringstream stream(given == nullptr ? "" : given);
    return {std::istream_iterator<std::string>(stream), {}};
}

// Throws Error where the container's OpenFOAM does not run.
void require_container(const std::string& work, const std::vector<std::string>& container) {
    const TemporaryFolder said;
    for (const char* program : {"simpleFoam", "pimpleFoam", "snappyHexMesh"}) {
        std::vector<std::string> words = container;
        words.insert(words.end(), {program, "-help"});
        int status = 127;
        try {
            status = run_subprocess(words, said.path() / "said");
        } catch (const Error&) {
            // reported below
        }
        if (status == 0) continue;
        throw Error(
            fmt::format("{} needs OpenFOAM, but '{}' fails with exit status {}; set SAMARA_OPENFOAM to the "
                        "command that runs a program in its container, such as 'apptainer exec openfoam.sif'",
                        work, fmt::join(words, " "), status));
    }
}

}  // namespace

void require_solvers(const FarmOptions& options, int ranks) {
    struct Need {
        const char* program;
        const char* package;
    };
    std::vector<Need> needs = {{"snakemake", "snakemake"}, {"python3", "python3"}};
    const std::vector<std::string> container = words_of_container();
    if (options.cluster.empty()) {
        if (container.empty()) {
            needs.insert(
                needs.begin(),
                {{"simpleFoam", "openfoam"}, {"pimpleFoam", "openfoam"}, {"snappyHexMesh", "openfoam"}});
        }
        if (ranks > 1) needs.push_back({"mpirun", "openmpi-bin"});
    } else {
        needs.insert(needs.end(), {{"squeue", "slurm-client"}, {"scancel", "slurm-client"}});
    }
    std::string missing;
    std::string packages;
    for (const Need& need : needs) {
        if (find_program(need.program)) continue;
        missing += fmt::format("{}{}", missing.empty() ? "" : ", ", need.program);
        if (packages.find(need.package) == std::string::npos) packages += fmt::format(" {}", need.package);
    }
    if (!missing.empty()) {
        throw Error(fmt::format("{} needs programs that are not on PATH: {}; on Debian: apt install{}",
                                options.work, missing, packages));
    }
    if (!options.cluster.empty()) {
        require_slurm();
    } else if (!container.empty()) {
        require_container(options.work, container);
    }
}

std::vector<LeftOutCase> solve_cases(const fs::path& folder, const BakePlan& plan, const FarmOptions& options,
                                     const fs::path& foam_cases) {
    end_earlier_jobs(folder);
    for (const Job& entry : jobs_of(plan)) {
        if (!is_settled(folder, entry)) fs::remove(folder / entry.name / check_log);
    }
    // A case whose start failed begins from the undisturbed flow, which needs another run of Snakemake.
    std::size_t left = unsettled(folder, plan).size();
    if (left > 0) require_room(folder, bytes_to_solve(folder, plan));
    while (left > 0) {
        run_snakemake(folder, plan, options, foam_cases);
        const std::size_t before = std::exchange(left, unsettled(folder, plan).size());
        if (left == before || !waits_for_failed_start(folder, plan)) break;
    }
    std::vector<LeftOutCase> left_out = left_out_cases(folder, plan);
    const std::size_t solved = count_solved(folder, plan);
    if (solved == 0 || solved + left_out.size() < jobs_of(plan).size()) {
        report_failure(folder, plan, !options.cluster.empty());
    }
    return left_out;
}

}  // namespace samara
