// The program samara-bake: from a shape or a scene to body files with tables.

#include <algorithm>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "foam-cases/bake/bake.hpp"
#include "foam-cases/bake/bake_report.hpp"
#include "foam-cases/farm/case_farm.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/replace_file.hpp"
#include "samara/scene/scene_file.hpp"
#include "samara/scene/terminal_speed.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

struct BakeOptions {
    std::string input;
    std::string output;
    std::string fluid = "water";
    double density = 1200.0;
    double other_density = 0.0;
    double scale = 1.0;
    int jobs = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 1024);
    int ranks = 1;
    std::string cluster;
    std::string quality = "preview";
    std::string loads;  ///< empty: the default closure of the quality
    std::string falls;  ///< empty: the closure of the loads
    double fall_step = 1.0;
    std::string inflow = "still";
    int probes = 0;
    bool whole_grid = false;
    double tolerance = SceneBakeOptions().tolerance;
    double budget = 0.0;
    int rounds = SceneBakeOptions().most_rounds;
    bool dry_run = false;
};

constexpr const char* no_falls = "none";

BakeQuality quality_of(const BakeOptions& options) {
    const Closure loads =
        options.loads.empty() ? usual_loads_closure(options.quality) : closure_of(options.loads);
    BakeQuality quality = with_loads_by(loads, bake_quality(options.quality));
    quality.fall_step = options.fall_step;
    if (options.falls.empty()) return quality;
    if (options.falls != no_falls) return with_falls_by(closure_of(options.falls), std::move(quality));
    quality.falls = 0;
    return quality;
}

Inflow inflow_of(const BakeOptions& options) {
    return options.inflow == "paper" ? paper_inflow() : Inflow();
}

void require_falls(const BakeOptions& options, const Arguments& arguments) {
    if (arguments.given("--density-to") && !arguments.given("--density")) {
        throw Error(
            fmt::format("{}: --density-to is the other end of a range; give --density too", options.input));
    }
    if (quality_of(options).falls > 0) return;
    for (const char* option : {"--density-to", "--fall-step"}) {
        if (!arguments.given(option)) continue;
        throw Error(
            fmt::format("{}: {} is of the falls that coefficients are identified from, and this bake has "
                        "none; bake at standard or high, without --falls none",
                        options.input, option));
    }
}

BakeRequest request_for_shape(const BakeOptions& options, bool density_is_given) {
    if (options.probes > 0 && fs::path(options.output).extension() != ".csv") {
        throw Error(
            fmt::format("{}: the output of --probes is a table of cases; name it NAME.csv", options.output));
    }
    if (options.probes == 0 && !is_body_file_name(options.output)) {
        throw Error(fmt::format("{}: the output is a body file; name it NAME.body.h5", options.output));
    }
    BakeRequest request;
    request.shape = options.input;
    request.scale = options.scale;
    request.output = options.output;
    request.fluid = *fluid_preset(options.fluid);
    // A body file may have its own mass.
    if (density_is_given || !is_body_file_name(options.input) || !read_body_file(options.input).mass) {
        request.mass.density = options.density;
    }
    request.other_density = options.other_density;
    request.quality = quality_of(options);
    request.inflow = inflow_of(options);
    request.probes = options.probes;
    return request;
}

bool is_scene(const std::string& input) {
    return fs::path(input).extension() == ".toml";
}

std::vector<BakeRequest> requests_for(const BakeOptions& options, const Arguments& arguments) {
    if (!options.dry_run) {
        const fs::path output = options.output;
        require_folder_to_make(is_scene(options.input) ? output : output.parent_path());
    }
    if (!is_scene(options.input)) {
        for (const char* option : {"--tolerance", "--budget", "--rounds", "--whole-grid"}) {
            if (arguments.given(option)) {
                throw Error(fmt::format("{}: {} is of a scene; a shape is baked in all directions",
                                        options.input, option));
            }
        }
        require_falls(options, arguments);
        return {request_for_shape(options, arguments.given("--density"))};
    }
    for (const char* option : {"--fluid", "--density", "--density-to", "--scale"}) {
        if (arguments.given(option)) {
            throw Error(
                fmt::format("{}: the scene says which fluid, density and scale its bodies have; drop {}",
                            options.input, option));
        }
    }
    if (options.probes > 0) {
        throw Error(fmt::format("{}: --probes takes a shape or a body file, not a scene", options.input));
    }
    if (fs::path(options.output).extension() == ".h5") {
        throw Error(
            fmt::format("{}: the output for a scene is a folder, for it gets one body file for each body",
                        options.output));
    }
    require_falls(options, arguments);
    SceneBakeOptions scene{.quality = quality_of(options),
                           .inflow = inflow_of(options),
                           .whole_grid = options.whole_grid,
                           .tolerance = options.tolerance,
                           .budget = {},
                           .most_rounds = options.rounds};
    if (arguments.given("--budget")) scene.budget = options.budget;
    return requests_for_scene(read_scene_file(options.input), options.output, scene);
}

nlohmann::json run_requests(const std::vector<BakeRequest>& requests, const BakeOptions& options,
                            bool quiet) {
    nlohmann::json results = nlohmann::json::array();
    BodyNotes notes("samara bake");
    for (const BakeRequest& request : requests) {
        nlohmann::json one;
        if (options.dry_run) {
            const BakePreparation preparation = prepare_bake(request);
            note_warnings(notes, request, preparation);
            if (!quiet) print_preparation(request, preparation, options.jobs);
            one = bake_as_json(request, preparation);
        } else {
            if (request.output.has_parent_path()) fs::create_directories(request.output.parent_path());
            const BakeResult result =
                bake_body(request, {options.jobs, options.cluster}, [&](const BakePreparation& preparation) {
                    note_warnings(notes, request, preparation);
                    notes.print();
                });
            warn_of_left_out_cases(request, result);
            warn_of_unbalanced_falls(request, result);
            if (!quiet) print_result(request, result);
            one = bake_as_json(request, result);
        }
        results.push_back(one);
    }
    notes.print();
    if (is_scene(options.input)) return {{"bodies", results}};
    return results.front();
}

int run(int argc, const char* const* argv) {
    BakeOptions options;
    Arguments arguments("samara bake",
                        "Bakes a body: mesh, Kirchhoff tensor, OpenFOAM cases, load and turbulence tables");
    arguments.positional("INPUT", options.input,
                         "a scene (.toml), or a shape (.geo .stl .obj .step ...) or body file (.body.h5)");
    arguments.required_option("-o,--output", options.output,
                              "NAME.body.h5; for a scene the folder of its body files");
    arguments.choice("--fluid", options.fluid, {"water", "air"}, "that the shape falls in, at 20 C");
    arguments.option("--density", options.density,
                     "of the body (kg/m^3); of a body file that has a mass: that", 1e-3, 1e6);
    arguments.option(
        "--density-to", options.other_density,
        "solves the falls at --density and at this density in turn, and the tables for the faster "
        "of the two: one body file for all densities between",
        1e-3, 1e6);
    arguments.option("--scale", options.scale, "metres for one unit of the shape file", 1e-12, 1e12);
    arguments.option("--jobs", options.jobs, "cases solved at once", 1, 4096);
    arguments.option("--ranks", options.ranks,
                     "processes that share each case, by MPI: for cases too large for one core; the cases "
                     "solved at once become fewer, unless --jobs says how many",
                     1, 1024);
    arguments.option(
        "--cluster", options.cluster,
        "a command of Slurm that submits a job, as \"sbatch --partition=short\": solves each case "
        "as a job there, --jobs of them at once; the output is in a folder that the nodes share");
    arguments.choice(
        "--quality", options.quality, bake_quality_names(),
        "smoke: seconds, for tests only; preview: half a minute on two cores; standard: three meshes "
        "and Reynolds numbers; high: four meshes, three closures");
    arguments.choice("--loads", options.loads, {"kEpsilon", "kOmegaSST", "kOmegaSSTLM"},
                     "closure that forces, moments and falls are solved by; where it is not given, "
                     "kOmegaSSTLM at standard and "
                     "high and kEpsilon below. k and epsilon are kEpsilon's, in cases of their own beside");
    arguments.choice("--falls", options.falls, {"kEpsilon", "kOmegaSST", "kOmegaSSTLM", no_falls},
                     "closure that the falls are solved by; else that of the loads. Their mesh is that of "
                     "samara validate, but for kEpsilon's beside loads by kEpsilon. "
                     "none: no falls, and so the coefficients that bodies have in common");
    arguments.option("--fall-step", options.fall_step,
                     "relative to the automatic step of a fall: 0.5 for a fall whose momenta do not balance",
                     0.05, 4.0);
    arguments.choice("--inflow", options.inflow, {"still", "paper"},
                     "turbulence of the fluid around: still: 1 % intensity; paper: its eq. 13, 100 %");
    arguments.option("--probes", options.probes,
                     "instead of tables: so many cases between the tables' nodes, to hold tables against; "
                     "the output is NAME.csv",
                     1, 1000);
    arguments.option(
        "--tolerance", options.tolerance,
        "for a scene: relative error of the descent speed that the tables' directions may leave; "
        "twice that of the frequency, three times of amplitude and rms angular speed",
        1e-4, 10.0);
    arguments.option("--budget", options.budget,
                     "for a scene: estimated CPU seconds for each body at which no more cases are added", 0.0,
                     1e9);
    arguments.option("--rounds", options.rounds, "for a scene: the most rounds of cases", 1, 100);
    arguments.flag("--whole-grid", options.whole_grid,
                   "for a scene: solves all directions, not only those that its bodies visit");
    arguments.flag("--dry-run", options.dry_run,
                   "only say what would be solved, how long it would take and how much of the disk");
    arguments.footer(fmt::format(
        "A scene's bodies are baked in rounds, in the directions in which they move ('samara plan' shows "
        "them);\n"
        "a shape in all directions. Its tables are made at the Reynolds number of the terminal speed, "
        "estimated\n"
        "with a drag coefficient of {:.1f} on the largest projected area. The cases are kept in NAME.cases "
        "beside the output: plain\n"
        "OpenFOAM cases with their logs, of which the next run reuses those whose inputs are unchanged.\n"
        "Needs OpenFOAM and Snakemake (Debian: apt install openfoam snakemake).\n"
        "Examples: samara bake meshes/shapes/ellipsoid.geo -o rubber.body.h5 --density 1200 --jobs 2\n"
        "          samara bake scene.toml -o bodies",
        terminal_drag_coefficient));
    return run_program(argc, argv, arguments, [&] {
        if (arguments.given("--cluster")) require_sbatch(options.cluster);
        if (!arguments.given("--jobs")) options.jobs = std::max(1, options.jobs / options.ranks);
        std::vector<BakeRequest> requests = requests_for(options, arguments);
        for (BakeRequest& request : requests) request.ranks = options.ranks;
        return run_requests(requests, options, arguments.json());
    });
}

}  // namespace
}  // namespace samara

int main(int argc, char** argv) {
    return samara::run(argc, argv);
}
