// The program samara-validate: solves a scene by full CFD and writes a motion file.

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "foam-cases/falls/validate.hpp"
#include "foam-cases/farm/case_farm.hpp"
#include "samara/analysis/metrics/description.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/files/replace_file.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/scene/scene_file.hpp"

namespace samara {
namespace {

struct ValidateOptions {
    std::string scene;
    std::string output;
    double cells = ValidationRequest().cells;
    double step = 1.0;
    std::string closure = std::string(name_of(ValidationRequest().closure));
    double fields = 0.0;
    int jobs = 1;
    std::string other_mesh;
    std::string other_closure;
    std::string cluster;
    bool dry_run = false;
};

nlohmann::json as_json(const BakePlan& plan) {
    const FreeFall& fall = plan.falls.front();
    return {{"mesh", fall.mesh},
            {"falls", plan.falls.size()},
            {"estimated_cells", cells_of(plan, fall.mesh)},
            {"reynolds_number", fall.reynolds_number},
            {"closure", name_of(fall.closure)},
            {"time_step", fall.time_step * fall.time_unit()},
            {"steps", fall.duration / fall.time_step},
            {"acceleration_relaxation", fall.acceleration_relaxation},
            {"estimated_cpu_seconds", plan.cpu_seconds}};
}

void print_plan(const BakePlan& plan) {
    const FreeFall& fall = plan.falls.front();
    print_result("{}{} cells, {:.0f} steps of {:.3g} ms, Reynolds number {:.3g}, {}: about {:.0f} CPU s{}\n",
                 plan.falls.size() == 1 ? "" : fmt::format("{} falls, each: ", plan.falls.size()),
                 fmt::format("{:.0f}", cells_of(plan, fall.mesh)), fall.duration / fall.time_step,
                 1e3 * fall.time_step * fall.time_unit(), fall.reynolds_number, name_of(fall.closure),
                 plan.cpu_seconds, plan.falls.size() == 1 ? "" : " in total");
}

/// Returns the one or two motion files of an option. Throws Error where one cannot be read, before the long
/// work.
std::vector<std::filesystem::path> motions_of(const char* option, const std::string& words) {
    const std::vector<std::string> names = comma_separated(words);
    const std::vector<std::filesystem::path> files(names.begin(), names.end());
    if (files.size() > 2) throw Error(fmt::format("{} needs one motion file, or two: A.h5,B.h5", option));
    for (const std::filesystem::path& file : files) (void)MotionReader(file);
    return files;
}

void print_warnings(const ValidationResult& result) {
    const auto note = [](const std::string& text) { print_note("samara validate: warning: {}\n", text); };
    const FallBalance balance = result.worst_balance();
    if (is_unbalanced(balance)) {
        note(
            fmt::format("the fall does not conserve momentum (force off by {:.0f} %, moment by {:.0f} %) and "
                        "is uncertain; halve its step with --step",
                        100.0 * balance.force, 100.0 * balance.moment));
    }
    if (result.largest_courant_number() > largest_good_courant_number) {
        note(fmt::format(
            "the Courant number reaches {:.1f}, and the fall may be inaccurate; halve its step with --step",
            result.largest_courant_number()));
    }
    for (std::size_t copy = 0; copy < result.solutions.size(); ++copy) {
        const std::vector<std::string>& attempts = result.solutions[copy].attempts;
        if (attempts.size() < 2) continue;
        note(fmt::format("the fall{} diverged at the planned settings and was solved with {}",
                         result.solutions.size() == 1 ? "" : fmt::format(" of copy {}", copy),
                         attempts.back()));
    }
}

OtherSolutions solutions_beside(const ValidateOptions& options) {
    OtherSolutions beside = {{"mesh", motions_of("--other-mesh", options.other_mesh)},
                             {"closure", motions_of("--other-closure", options.other_closure)}};
    std::erase_if(beside, [](const auto& one) { return one.second.empty(); });
    return beside;
}

void make_folder_of(const std::filesystem::path& file) {
    if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
}

/// Writes a solved motion with new uncertainties.
nlohmann::json judge_again(const ValidateOptions& options, bool quiet) {
    const OtherSolutions beside = solutions_beside(options);
    if (options.dry_run)
        throw Error(
            fmt::format("{}: is a solved motion; leave --dry-run out, or give a scene", options.scene));
    if (beside.empty()) {
        throw Error(fmt::format(
            "{}: is a solved motion; give a motion to compare it with, by --other-mesh or --other-closure",
            options.scene));
    }
    const Motion motion = with_uncertainties(options.scene, beside);
    make_folder_of(options.output);
    write_motion_file(options.output, motion);
    const BodyMeasures measures = measure_all(motion, motion.bodies.front());
    if (!quiet) {
        print_result("{}\n{}  solved earlier -> {}\n", motion.bodies.front().name, as_text(measures),
                     options.output);
    }
    return {{"output", options.output}, {"reused", true}, {"body", as_json(measures)}};
}

nlohmann::json run_validation(const ValidateOptions& options, bool quiet) {
    require_motion_file_name(options.output);
    if (!options.dry_run) {
        require_folder_to_make(std::filesystem::path(options.output).parent_path());
    }
    if (is_motion_file(options.scene)) return judge_again(options, quiet);
    ValidationRequest request;
    request.scene = read_scene_file(options.scene);
    request.output = options.output;
    request.cells = options.cells;
    request.step = options.step;
    request.fields = options.fields;
    request.closure = closure_of_falls(options.closure);
    request.beside = solutions_beside(options);
    if (options.dry_run) {
        const BakePlan plan = prepare_validation(request);
        if (!quiet) print_plan(plan);
        return as_json(plan);
    }
    make_folder_of(request.output);
    const ValidationResult result =
        validate_scene(request, {options.jobs, options.cluster, "solving"}, [](const BakePlan&) {});
    print_warnings(result);
    const BodyMeasures measures = measure_all(result.motion, result.motion.bodies.front());
    nlohmann::json json = as_json(result.plan);
    json["output"] = options.output;
    json["reused"] = result.reused == result.solutions.size();
    json["cpu_seconds"] = result.cpu_seconds;
    const FallSolution& first = result.solutions.front();
    const FallBalance balance = result.worst_balance();
    json["time_step"] = first.time_step * result.plan.falls.front().time_unit();
    json["cells"] = first.cells;
    // The attempts of the fall that needed most.
    json["attempts"] = std::ranges::max(result.solutions, {}, [](const FallSolution& solution) {
                           return solution.attempts.size();
                       }).attempts;
    json["largest_courant_number"] = result.largest_courant_number();
    json["balance"] = {{"force", balance.force}, {"moment", balance.moment}};
    json["body"] = as_json(measures);
    if (!quiet) {
        print_result(
            "{}\n"
            "{}  momentum balance: force {:.1f} %, moment {:.1f} %; largest Courant number {:.2g}\n"
            "{:.0f} CPU s{} -> {}\n",
            result.motion.bodies.front().name, as_text(measures), 100.0 * balance.force,
            100.0 * balance.moment, result.largest_courant_number(), result.cpu_seconds,
            result.reused == result.solutions.size() ? " earlier" : "", options.output);
    }
    return json;
}

int run(int argc, const char* const* argv) {
    ValidateOptions options;
    Arguments arguments("samara validate", "Solves a scene by full CFD, as a reference for samara simulate");
    arguments.positional("SCENE", options.scene,
                         "scene file (.toml) with one body, whose copies are solved as separate falls; or a "
                         "solved motion file, to compare it with others");
    arguments.required_option("-o,--output", options.output, "motion file to write (.h5)");
    arguments.option(
        "--cells", options.cells,
        "approximate number of mesh cells; kEpsilon uses the nearest of 6,000, 20,000, 60,000 and 200,000",
        1e3, 1e7);
    arguments.option("--closure", options.closure,
                     "turbulence closure above Reynolds number 300: kOmegaSSTLM, kOmegaSST, kOmegaSSTDDES "
                     "(resolves eddies), laminar (none) or kEpsilon");
    arguments.option("--step", options.step, "time step relative to the automatic step", 0.05, 4.0);
    arguments.option("--fields", options.fields,
                     "stores the flow field this many times per second, for a movie: velocity and pressure "
                     "in NAME.cases/fall_00/postProcessing/fields, for ParaView; 0: never",
                     0.0, 1e4);
    arguments.option("--jobs", options.jobs, "falls solved in parallel, if the body has copies", 1, 4096);
    arguments.option("--other-mesh", options.other_mesh,
                     "motion file of the same scene on another mesh: the difference is stored as the "
                     "motion's mesh uncertainty, which samara compare uses");
    arguments.option("--other-closure", options.other_closure,
                     "like --other-mesh, for another closure; or A.h5,B.h5: two motions on another mesh that "
                     "differ only in the closure");
    arguments.option("--cluster", options.cluster,
                     "Slurm command that submits a job, such as \"sbatch --partition=short\": solves each "
                     "fall as a cluster job");
    arguments.flag("--dry-run", options.dry_run,
                   "report what would be solved and how long it would take, and stop");
    arguments.footer(
        "OpenFOAM (pimpleFoam, six degrees of freedom) solves one fall for each copy of the body, in the "
        "folder\n"
        "NAME.cases beside the output: a plain case for OpenFOAM and ParaView. Run the command again to "
        "continue an\n"
        "interrupted fall. The scene's keys for loads and turbulence are ignored, as the flow itself is "
        "solved.\n"
        "Compare with a simulated motion: samara compare motion.h5 reference.h5\n"
        "Needs OpenFOAM and Snakemake (Debian: apt install openfoam snakemake).\n");
    return run_program(argc, argv, arguments, [&] {
        if (arguments.given("--cluster")) require_sbatch(options.cluster);
        return run_validation(options, arguments.json());
    });
}

}  // namespace
}  // namespace samara

int main(int argc, char** argv) {
    return samara::run(argc, argv);
}
