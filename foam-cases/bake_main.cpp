// The program samara-bake: from a shape or a scene to body files with tables.

#include <algorithm>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "foam-cases/bake.hpp"
#include "foam-cases/bake_report.hpp"
#include "foam-cases/cluster_jobs.hpp"
#include "foam-cases/terminal_speed.hpp"
#include "samara/base/error.hpp"
#include "samara/body/body_file.hpp"
#include "samara/command/arguments.hpp"
#include "samara/scene/scene_file.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;

struct BakeOptions {
    std::string input;
    std::string output;
    std::string fluid = "water";
    double density = 1200.0;
    int jobs = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 1024);
    int ranks = 1;
    std::string cluster;
    std::string quality = "preview";
    std::string inflow = "still";
    int probes = 0;
    bool dry_run = false;
};

void take_options(const BakeOptions& options, BakeRequest& request) {
    request.quality = bake_quality(options.quality);
    if (options.inflow == "paper") request.inflow = paper_inflow();
    request.probes = options.probes;
}

BakeRequest request_for_shape(const BakeOptions& options) {
    if (options.probes > 0 && fs::path(options.output).extension() != ".csv") {
        throw Error(
            fmt::format("{}: the output of --probes is a table of cases; name it NAME.csv", options.output));
    }
    if (options.probes == 0 && !is_body_file_name(options.output)) {
        throw Error(fmt::format("{}: the output is a body file; name it NAME.body.h5", options.output));
    }
    BakeRequest request;
    request.shape = options.input;
    request.output = options.output;
    request.fluid = *fluid_preset(options.fluid);
    request.mass.density = options.density;
    take_options(options, request);
    return request;
}

std::vector<BakeRequest> requests_for_scene(const BakeOptions& options) {
    const Scene scene = read_scene_file(options.input);
    std::vector<BakeRequest> requests;
    for (const SceneBody& body : scene.bodies) {
        BakeRequest request;
        request.name = body.name;
        request.shape = body.shape;
        request.scale = body.scale;
        request.output = fs::path(options.output) / (body.name + ".body.h5");
        request.fluid = scene.fluid;
        request.mass = body.mass;
        request.gravity = scene.gravity.norm();
        take_options(options, request);
        request.tables = body.loads == Loads::table || body.turbulence == Turbulence::table;
        requests.push_back(request);
    }
    return requests;
}

bool is_scene(const std::string& input) {
    return fs::path(input).extension() == ".toml";
}

std::vector<BakeRequest> requests_for(const BakeOptions& options, const Arguments& arguments) {
    if (!is_scene(options.input)) return {request_for_shape(options)};
    for (const char* option : {"--fluid", "--density"}) {
        if (arguments.given(option)) {
            throw Error(fmt::format("{}: the scene says of which fluid and density its bodies are; drop {}",
                                    options.input, option));
        }
    }
    if (options.probes > 0) {
        throw Error(fmt::format("{}: --probes takes a shape or a body file, not a scene", options.input));
    }
    if (is_body_file_name(options.output)) {
        throw Error(
            fmt::format("{}: the output for a scene is a folder, for it gets one body file for each body",
                        options.output));
    }
    return requests_for_scene(options);
}

nlohmann::json run_requests(const std::vector<BakeRequest>& requests, const BakeOptions& options,
                            bool quiet) {
    nlohmann::json results = nlohmann::json::array();
    for (const BakeRequest& request : requests) {
        nlohmann::json one;
        if (options.dry_run) {
            const BakePreparation preparation = prepare_bake(request);
            note_laminar_flow(preparation);
            if (!quiet) print_preparation(request, preparation, options.jobs);
            one = bake_as_json(request, preparation);
        } else {
            if (request.output.has_parent_path()) fs::create_directories(request.output.parent_path());
            const BakeResult result = bake_body(request, {options.jobs, options.cluster}, note_laminar_flow);
            warn_of_left_out_cases(request, result);
            if (!quiet) print_result(request, result);
            one = bake_as_json(request, result);
        }
        results.push_back(one);
    }
    if (is_scene(options.input)) return {{"bodies", results}};
    return results.front();
}

int run(int argc, const char* const* argv) {
    BakeOptions options;
    Arguments arguments("samara-bake",
                        "Bakes a body: mesh, Kirchhoff tensor, OpenFOAM cases, load and turbulence tables");
    arguments.positional("INPUT", options.input,
                         "a scene (.toml), or a shape (.geo .stl .obj .step) or body file (.body.h5)");
    arguments.required_option("-o,--output", options.output,
                              "NAME.body.h5; for a scene the folder of its body files");
    arguments.choice("--fluid", options.fluid, {"water", "air"}, "that the shape falls in, at 20 C");
    arguments.option("--density", options.density, "of the body (kg/m^3)", 1e-3, 1e6);
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
        "smoke: seconds, for tests only; preview: two minutes on two cores; standard: three meshes "
        "and Reynolds numbers; high: four meshes, three closures");
    arguments.choice("--inflow", options.inflow, {"still", "paper"},
                     "turbulence of the fluid around: still: 1 % intensity; paper: its eq. 13, 100 %");
    arguments.option("--probes", options.probes,
                     "instead of tables: so many cases between the tables' nodes, to hold tables against; "
                     "the output is NAME.csv",
                     1, 1000);
    arguments.flag("--dry-run", options.dry_run, "only say what would be solved and how long it would take");
    arguments.footer(fmt::format(
        "The tables are made at the Reynolds number of the terminal speed, estimated with a drag "
        "coefficient\n"
        "of {:.1f} on the largest projected area. The cases are kept in NAME.cases beside the output: plain\n"
        "OpenFOAM cases with their logs, of which the next run reuses those whose inputs are unchanged.\n"
        "Needs OpenFOAM and Snakemake (Debian: apt install openfoam snakemake).\n"
        "Examples: samara bake meshes/ellipsoid.geo -o rubber.body.h5 --density 1200 --jobs 2\n"
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
