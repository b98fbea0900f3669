#include "foam-cases/case_farm.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

#include <fmt/format.h>

#include "converter/case_reduction.hpp"
#include "foam-cases/guarded_process.hpp"
#include "samara/base/content_hash.hpp"
#include "samara/base/error.hpp"
#include "samara/command/progress.hpp"
#include "samara/command/subprocess.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

std::string last_line(const fs::path& file) {
    if (!fs::exists(file)) return {};
    std::istringstream lines(read_bytes(file));
    std::string last;
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty()) last = line;
    }
    return last;
}

// The line that check_case.py left for the mesh or case, its paths taken from here.
std::string fault_of(const fs::path& folder, const std::string& name) {
    std::string line = last_line(folder / name / "log.check");
    if (line.empty()) {
        return fmt::format("{}: was not run; see {}", (folder / name).string(),
                           (folder / "log.snakemake").string());
    }
    const std::string inside = " " + name + "/";
    const std::string outside = fmt::format(" {}/{}/", folder.string(), name);
    for (std::size_t at = line.find(inside); at != std::string::npos;
         at = line.find(inside, at + outside.size())) {
        line.replace(at, inside.size(), outside);
    }
    return fmt::format("{}/{}", folder.string(), line);
}

[[noreturn]] void report_failure(const fs::path& folder, const BakePlan& plan) {
    if (!fs::exists(folder / "mesh/mesh.json")) throw Error(fault_of(folder, "mesh"));
    const std::size_t failed = plan.cases.size() - count_solved(folder, plan);
    if (failed == 0) {
        throw Error(fmt::format("snakemake failed; see {}", (folder / "log.snakemake").string()));
    }
    const auto first = std::find_if(plan.cases.begin(), plan.cases.end(),
                                    [&](const BakeCase& entry) { return !is_solved(folder / entry.name); });
    throw Error(fmt::format("{} ({} of {} cases failed; the solved ones are kept for the next run)",
                            fault_of(folder, first->name), failed, plan.cases.size()));
}

/// How far a case has come, 0 to 1: a line of its history of forces for each iteration.
double solved_share(const fs::path& case_folder, int iterations) {
    if (is_solved(case_folder)) return 1.0;
    std::ifstream history(case_folder / "postProcessing/forces/0/force.dat");
    int lines = 0;
    for (std::string line; std::getline(history, line);) lines += line.starts_with('#') ? 0 : 1;
    return std::min(1.0, static_cast<double>(lines) / iterations);
}

}  // namespace

std::size_t count_solved(const fs::path& folder, const BakePlan& plan) {
    return static_cast<std::size_t>(
        std::count_if(plan.cases.begin(), plan.cases.end(),
                      [&](const BakeCase& entry) { return is_solved(folder / entry.name); }));
}

void require_solvers() {
    struct Need {
        const char* program;
        const char* package;
    };
    constexpr Need needs[] = {{"simpleFoam", "openfoam"},
                              {"snappyHexMesh", "openfoam"},
                              {"snakemake", "snakemake"},
                              {"python3", "python3"}};
    std::string missing;
    std::string packages;
    for (const Need& need : needs) {
        if (find_program(need.program)) continue;
        missing += fmt::format("{}{}", missing.empty() ? "" : ", ", need.program);
        if (packages.find(need.package) == std::string::npos) packages += fmt::format(" {}", need.package);
    }
    if (missing.empty()) return;
    throw Error(fmt::format("baking needs programs that are not on PATH: {}; on Debian: apt install{}",
                            missing, packages));
}

void solve_cases(const fs::path& folder, const BakePlan& plan, int jobs, const fs::path& templates) {
    const std::size_t solved_before = count_solved(folder, plan);
    const std::size_t to_solve = plan.cases.size() - solved_before;
    if (to_solve == 0 && fs::exists(folder / "mesh/mesh.json")) return;
    Progress progress("baking", "cases");
    const auto tick = [&] {
        double done = -static_cast<double>(solved_before);
        for (const BakeCase& entry : plan.cases) {
            done += solved_share(folder / entry.name, plan.quality.iterations);
        }
        progress.update(done, static_cast<double>(to_solve));
    };
    for (const BakeCase& entry : plan.cases) {
        if (!is_solved(folder / entry.name)) fs::remove(folder / entry.name / "log.check");
    }
    const auto status =
        run_guarded({"snakemake", "--snakefile", (templates / "Snakefile").string(), "--directory",
                     folder.string(), "--cores", fmt::format("{}", jobs), "--keep-going", "--nolock",
                     "--ignore-incomplete", "--rerun-triggers", "mtime", "--quiet", "all"},
                    folder / "log.snakemake", fs::current_path(), tick);
    if (!status) {
        throw Error(
            fmt::format("interrupted: {} of {} cases are solved and kept in {}; the same command goes "
                        "on from there",
                        count_solved(folder, plan), plan.cases.size(), folder.string()));
    }
    if (*status != 0 || count_solved(folder, plan) < plan.cases.size()) report_failure(folder, plan);
}

}  // namespace samara
