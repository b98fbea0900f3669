// The program samara-bake: from a shape or a scene to body files with tables.

#include <algorithm>
#include <charconv>
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
#include "samara/commands/shared/load_body.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/base/text.hpp"
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
    double fluid_density = 0.0;
    double fluid_viscosity = 0.0;
    std::string reynolds_numbers;
    double density = 1200.0;
    double other_density = 0.0;
    ShapeReading reading;
    int jobs = std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, 1024);
    int ranks = 1;
    std::string cluster;
    std::string quality = usual_quality;
    std::string loads;  ///< empty: the default closure of the quality
    std::string turbulence = "kEpsilon";
    std::string falls;  ///< empty: the closure of the loads
    double fall_step = 1.0;
    std::string inflow = "still";
    int probes = 0;
    bool turbulence_only = false;
    bool whole_grid = false;
    double tolerance = SceneBakeOptions().tolerance;
    double budget = 0.0;
    int rounds = SceneBakeOptions().most_rounds;
    std::string bodies;  ///< of a scene, comma-separated; empty: all
    bool dry_run = false;
};

constexpr const char* no_falls = "none";

BakeQuality quality_of(const BakeOptions& options) {
    const Closure loads =
        options.loads.empty() ? usual_loads_closure(options.quality) : closure_of(options.loads);
    BakeQuality quality = with_turbulence_by(closure_of(options.turbulence),
                                             with_loads_by(loads, bake_quality(options.quality)));
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
        throw Error(fmt::format("{}: --density-to needs --density; give both", options.input));
    }
    if (quality_of(options).falls > 0) return;
    for (const char* option : {"--density-to", "--fall-step"}) {
        if (!arguments.given(option)) continue;
        throw Error(
            fmt::format("{}: {} applies to falls, and this bake solves none; leave it out, or bake at "
                        "standard or high, without --falls none",
                        options.input, option));
    }
}

/// Returns the quality of a bake of k and epsilon alone, by that closure.
BakeQuality quality_of_turbulence(const std::string& name, const std::string& closure) {
    BakeQuality quality = bake_quality(name);
    quality.loads_closure = quality.turbulence_closure = closure_of(closure);
    quality.falls = 0;
    return quality;
}

/// Returns the body of a file with tables. Throws Error where it has none.
Body baked_body(const std::string& file) {
    Body body = read_body_file(file);
    if (body.tables) return body;
    throw Error(fmt::format(
        "{}: has no tables whose k and epsilon could be replaced; bake it without --turbulence-only", file));
}

/// Returns the fluid around a shape: a preset, or that of a density and a viscosity, which go together.
Fluid fluid_of(const BakeOptions& options, const Arguments& arguments) {
    const bool density = arguments.given("--fluid-density");
    const bool viscosity = arguments.given("--fluid-viscosity");
    if (!density && !viscosity) return *fluid_preset(options.fluid);
    if (arguments.given("--fluid")) {
        throw Error(fmt::format("{}: --fluid excludes --fluid-density and --fluid-viscosity; leave it out",
                                options.input));
    }
    if (!density || !viscosity) {
        throw Error(fmt::format("{}: {} is not enough; give --fluid-density and --fluid-viscosity",
                                options.input, density ? "--fluid-density" : "--fluid-viscosity"));
    }
    return Fluid{.density = options.fluid_density, .viscosity = options.fluid_viscosity};
}

/// Returns the Reynolds numbers of --reynolds-number, to three digits, the main one first; none without it.
std::vector<double> reynolds_numbers_of(const BakeOptions& options, const Arguments& arguments) {
    if (!arguments.given("--reynolds-number")) return {};
    const auto rejected = [&](const std::string& why) {
        return Error(
            fmt::format("{}: --reynolds-number '{}' {}", options.input, options.reynolds_numbers, why));
    };
    if (arguments.given("--fluid-viscosity")) {
        throw rejected("sets the viscosity; leave --fluid-density and --fluid-viscosity out");
    }
    std::vector<double> numbers;
    for (const std::string& word : comma_separated(options.reynolds_numbers)) {
        double number = 0.0;
        const char* const end = word.data() + word.size();
        const auto [rest, failure] = std::from_chars(word.data(), end, number);
        if (failure != std::errc() || rest != end || !(number >= 0.01 && number <= 1e7)) {
            throw rejected("must be numbers from 0.01 to 1e7, by commas, such as 5000,500,50");
        }
        numbers.push_back(rounded_reynolds_number(number));
        if (std::ranges::count(numbers, numbers.back()) > 1) {
            throw rejected("names a number twice, to three digits; give each once");
        }
    }
    if (numbers.empty()) throw rejected("names none; give numbers by commas, such as 5000,500,50");
    if (options.probes > 0 && numbers.size() > 1) {
        throw rejected("must be one number with --probes, which solves between it and a tenth of it");
    }
    return numbers;
}

BakeRequest request_for_shape(const BakeOptions& options, const Arguments& arguments) {
    if (options.probes > 0 && fs::path(options.output).extension() != ".csv") {
        throw Error(
            fmt::format("{}: the output of --probes is a table of cases; name it NAME.csv", options.output));
    }
    if (options.probes == 0 && !is_body_file_name(options.output)) {
        throw Error(fmt::format("{}: the output is a body file; name it NAME.body.h5", options.output));
    }
    BakeRequest request;
    request.shape = options.input;
    request.reading = options.reading;
    request.output = options.output;
    request.fluid = fluid_of(options, arguments);
    // A body file may have its own mass.
    if (arguments.given("--density") || !is_body_file_name(options.input) ||
        !read_body_file(options.input).mass) {
        request.mass.density = options.density;
    }
    request.other_density = options.other_density;
    request.quality = quality_of(options);
    if (const std::vector<double> numbers = reynolds_numbers_of(options, arguments); !numbers.empty()) {
        request.reynolds_number = numbers.front();
        request.quality.further_reynolds_numbers.clear();
        for (std::size_t i = 1; i < numbers.size(); ++i) {
            request.quality.further_reynolds_numbers.push_back(numbers[i] / numbers.front());
        }
    }
    if (options.turbulence_only) {
        request.baked = baked_body(options.input);
        const std::vector<std::string> names = bake_quality_names();
        const std::string& own = request.baked->tables->quality;
        const bool by_own = !arguments.given("--quality") && std::ranges::find(names, own) != names.end();
        request.quality = quality_of_turbulence(by_own ? own : options.quality, options.turbulence);
    }
    request.inflow = inflow_of(options);
    request.probes = options.probes;
    return request;
}

/// Throws where --turbulence-only has no tables to replace, or stands beside options of loads.
void require_for_turbulence_only(const BakeOptions& options, const Arguments& arguments) {
    if (!options.turbulence_only) return;
    if (!is_body_file_name(options.input)) {
        throw Error(
            fmt::format("{}: --turbulence-only needs a baked body file, NAME.body.h5; bake the shape whole",
                        options.input));
    }
    for (const char* option : {"--fluid", "--fluid-density", "--fluid-viscosity", "--reynolds-number",
                               "--density", "--density-to", "--loads", "--falls", "--fall-step"}) {
        if (!arguments.given(option)) continue;
        throw Error(fmt::format(
            "{}: with --turbulence-only loads and Reynolds numbers stay those of the body file; leave {} out",
            options.input, option));
    }
}

/// Keeps the requests of the bodies that --body names. Throws where the scene has none of that name.
void keep_bodies(const BakeOptions& options, std::vector<BakeRequest>& requests) {
    if (options.bodies.empty()) return;
    const std::vector<std::string> bodies = comma_separated(options.bodies);
    std::vector<std::string> names;
    for (const BakeRequest& request : requests) names.push_back(request.name);
    for (const std::string& body : bodies) {
        if (std::ranges::find(names, body) != names.end()) continue;
        throw Error(fmt::format("{}: --body {}: the scene has no body of that name{}", options.input, body,
                                did_you_mean(body, names)));
    }
    std::erase_if(requests, [&](const BakeRequest& request) {
        return std::ranges::find(bodies, request.name) == bodies.end();
    });
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
        for (const char* option : {"--tolerance", "--budget", "--rounds", "--whole-grid", "--body"}) {
            if (arguments.given(option)) {
                throw Error(fmt::format(
                    "{}: {} applies to scenes only, as a shape is baked in all directions; leave it out",
                    options.input, option));
            }
        }
        require_falls(options, arguments);
        require_for_turbulence_only(options, arguments);
        return {request_for_shape(options, arguments)};
    }
    for (const char* option : {"--fluid", "--fluid-density", "--fluid-viscosity", "--reynolds-number",
                               "--density", "--density-to", "--scale", "--turbulence-only"}) {
        if (arguments.given(option)) {
            throw Error(fmt::format(
                "{}: a scene defines fluid, speeds, density and scale of its bodies, which are baked whole; "
                "leave {} out",
                options.input, option));
        }
    }
    if (options.probes > 0) {
        throw Error(fmt::format("{}: --probes needs a shape or a body file, not a scene; give one of these",
                                options.input));
    }
    if (fs::path(options.output).extension() == ".h5") {
        throw Error(fmt::format(
            "{}: the output for a scene is a folder with one body file for each body; give a folder",
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
    std::vector<BakeRequest> requests =
        requests_for_scene(read_scene_file(options.input), options.output, scene);
    keep_bodies(options, requests);
    return requests;
}

nlohmann::json run_requests(const std::vector<BakeRequest>& requests, const BakeOptions& options,
                            bool quiet) {
    nlohmann::json results = nlohmann::json::array();
    BodyNotes notes("samara bake");
    FarmWork work;
    for (const BakeRequest& request : requests) {
        nlohmann::json one;
        if (options.dry_run) {
            const BakePreparation preparation = prepare_bake(request);
            note_warnings(notes, request, preparation);
            work.add(preparation.work);
            if (!quiet) print_preparation(request, preparation, options.jobs);
            one = bake_as_json(request, preparation);
        } else {
            if (request.output.has_parent_path()) fs::create_directories(request.output.parent_path());
            const BakeResult result =
                bake_body(request, {options.jobs, options.cluster}, [&](const BakePreparation& preparation) {
                    note_warnings(notes, request, preparation);
                    notes.print();
                    note_cost(request, preparation, options.jobs);
                });
            warn_of_left_out_cases(request, result);
            warn_of_unbalanced_falls(request, result);
            if (!quiet) print_result(request, result);
            one = bake_as_json(request, result);
        }
        results.push_back(one);
    }
    notes.print();
    if (options.dry_run && !quiet && results.size() > 1) print_total(results, work, options.jobs);
    if (is_scene(options.input)) return {{"bodies", results}};
    return results.front();
}

int run(int argc, const char* const* argv) {
    BakeOptions options;
    Arguments arguments(
        "samara bake",
        "Bakes a body: mesh, Kirchhoff tensor, load and turbulence tables from OpenFOAM cases");
    arguments.positional("INPUT", options.input,
                         "a scene (.toml), or a shape (.geo .stl .obj .step ...) or body file (.body.h5)");
    arguments.required_option("-o,--output", options.output,
                              "NAME.body.h5; for a scene, the folder for its body files");
    arguments.choice("--fluid", options.fluid, {"water", "air"}, "fluid around the shape, at 20 C");
    arguments.option("--fluid-density", options.fluid_density,
                     "density of the fluid around the shape (kg/m^3), with --fluid-viscosity", 1e-6, 1e6);
    arguments.option(
        "--fluid-viscosity", options.fluid_viscosity,
        "dynamic viscosity of that fluid (Pa s): 1.41 and a density of 1261 are glycerol at 20 C", 1e-9, 1e6);
    arguments.option(
        "--reynolds-number", options.reynolds_numbers,
        "R[,R...]: Reynolds numbers U L/nu of the tables, in place of that of the terminal speed "
        "and those of the quality; the first is solved in all directions, the others in few");
    arguments.option("--density", options.density,
                     "density of the body (kg/m^3); by default that of the body file", 1e-3, 1e6);
    arguments.option("--density-to", options.other_density,
                     "solves falls at --density and at this density alternately, and the tables for the "
                     "faster of the two: one body file for all densities in between",
                     1e-3, 1e6);
    arguments.option("--scale", options.reading.scale, "size of the shape file's unit, m", 1e-12, 1e12);
    arguments.option("--thickness", options.reading.thickness, thickness_help, 0.0, 1e12);
    arguments.option("--jobs", options.jobs, "cases solved in parallel", 1, 4096);
    arguments.option("--ranks", options.ranks,
                     "MPI processes for each case, for cases too large for one core; by default fewer cases "
                     "are then solved in parallel",
                     1, 1024);
    arguments.option(
        "--cluster", options.cluster,
        "Slurm command that submits a job, such as \"sbatch --partition=short\": solves each case as a "
        "cluster job, --jobs in parallel; the output must be in a folder that the nodes share");
    arguments.choice(
        "--quality", options.quality, bake_quality_names(),
        "smoke: seconds, for tests only; preview: half a minute on two cores, for trying a bake; "
        "standard: three meshes and Reynolds numbers, and two falls; high: four meshes and three "
        "closures");
    arguments.choice("--loads", options.loads, {"kEpsilon", "kOmegaSST", "kOmegaSSTLM"},
                     "closure for forces, moments and falls; by default kOmegaSSTLM at standard and high, "
                     "kEpsilon at lower qualities");
    arguments.choice(
        "--closure", options.turbulence, turbulence_closures(),
        "closure for k and epsilon, which have cases of their own unless the loads have the same");
    arguments.choice("--falls", options.falls, {"kEpsilon", "kOmegaSST", "kOmegaSSTLM", no_falls},
                     "closure for the falls; by default that of the loads. The mesh is that of samara "
                     "validate, except for kEpsilon with loads by kEpsilon. none: no falls; the body gets "
                     "the default dynamic coefficients");
    arguments.option("--fall-step", options.fall_step,
                     "time step of the falls relative to the automatic step; a fall that does not conserve "
                     "momentum is solved again with half of it",
                     0.05, 4.0);
    arguments.choice(
        "--inflow", options.inflow, {"still", "paper"},
        "turbulence of the ambient fluid: still: 1 % intensity; paper: eq. 13 of the paper, 100 %");
    arguments.flag(
        "--turbulence-only", options.turbulence_only,
        "solve k and epsilon alone, and replace them in the tables of INPUT, a baked body file: for "
        "files of earlier versions, or another --closure");
    arguments.option("--probes", options.probes,
                     "instead of tables, solve this many cases between the tables' nodes, to test tables "
                     "with; the output is NAME.csv",
                     1, 1000);
    arguments.option(
        "--tolerance", options.tolerance,
        "for a scene: tolerance of the descent speed for errors from the number of directions, relative; the "
        "frequency may be off by twice, amplitude and rms angular speed by three times as much",
        1e-4, 10.0);
    arguments.option(
        "--budget", options.budget,
        "for a scene: budget of CPU seconds for each body (estimated); no cases are added beyond it", 0.0,
        1e9);
    arguments.option("--rounds", options.rounds, "for a scene: maximum number of rounds of cases", 1, 100);
    arguments.option("--body", options.bodies, "NAME[,NAME...]: for a scene: bake these of its bodies alone");
    arguments.flag("--whole-grid", options.whole_grid,
                   "for a scene: solve all directions, not only those in which its bodies move");
    arguments.flag("--dry-run", options.dry_run,
                   "report what would be solved, with its time and disk space, and stop");
    arguments.footer(fmt::format(
        "A scene's bodies are baked in rounds, in the directions in which they move ('samara plan' shows "
        "them);\n"
        "a shape is baked in all directions. The tables are for the Reynolds number of the terminal speed,\n"
        "estimated with a drag coefficient of {:.1f} on the largest projected area. The cases are kept in\n"
        "NAME.cases beside the output, as plain OpenFOAM cases with logs; the next run reuses those whose "
        "inputs\n"
        "are unchanged.\n"
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
