// samara simulate: a scene -> a motion file.

#include <atomic>
#include <csignal>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "commands/table_errors_report.hpp"
#include "samara/base/content_hash.hpp"
#include "samara/base/error.hpp"
#include "samara/base/vector_json.hpp"
#include "samara/body/body_file.hpp"
#include "samara/command/arguments.hpp"
#include "samara/command/load_body.hpp"
#include "samara/command/progress.hpp"
#include "samara/kirchhoff/kirchhoff_solver.hpp"
#include "samara/motion/description.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/motion/motion_writer.hpp"
#include "samara/scene/scene_file.hpp"
#include "samara/simulation/model_advice.hpp"
#include "samara/simulation/simulation.hpp"

namespace samara {
namespace {

struct Request {
    std::string scene;
    std::string output;
    std::string bodies;
    std::uint64_t seed = 0;
    double step = 0.0;
    int runs = 1;
    int threads = 0;
};

std::atomic<bool> interrupted = false;

extern "C" void note_interrupt(int /*signal*/) {
    interrupted = true;
}

/// The file a body of the scene flies with: the baked one where a folder of them is given.
std::filesystem::path file_of(const SceneBody& scene_body, const std::string& bodies) {
    if (bodies.empty()) return scene_body.shape;
    const auto baked = std::filesystem::path(bodies) / (scene_body.name + ".body.h5");
    if (!std::filesystem::exists(baked)) {
        throw Error(fmt::format("{}: there is no such file; bake it with 'samara bake SCENE -o {}'",
                                baked.string(), bodies));
    }
    return baked;
}

/// Says where the added mass is too uncertain to trust the motion.
void warn_of_added_mass(const SceneBody& scene_body, const KirchhoffTensor& kirchhoff) {
    constexpr double doubtful = 0.2;
    if (kirchhoff.error_estimate <= doubtful) return;
    fmt::print(stderr,
               "samara simulate: note: the added mass of '{}' may be wrong by {:.0f} % (error estimate): the "
               "body is "
               "thin or its mesh coarse\n",
               scene_body.name, 100.0 * kirchhoff.error_estimate);
}

/// Refuses a body that was baked before its shape was changed.
void require_same_shape(const std::filesystem::path& file, const Body& body, const SceneBody& scene_body) {
    if (is_body_file_name(scene_body.shape)) return;
    if (body.source.find(file_content_hash(scene_body.shape)) != std::string::npos) return;
    throw Error(fmt::format("{}: was made from another shape than {} is now; bake the scene again",
                            file.string(), scene_body.shape.string()));
}

CastBody cast_body(const SceneBody& scene_body, const std::string& bodies) {
    const std::filesystem::path file = file_of(scene_body, bodies);
    // A baked body is in metres already: the scene's scale went into it.
    CastBody cast{load_body(file, bodies.empty() ? scene_body.scale : 1.0), file_content_hash(file)};
    if (!bodies.empty()) require_same_shape(file, cast.body, scene_body);
    if (!scene_body.added_mass) return cast;
    if (!cast.body.kirchhoff) {
        cast.body.kirchhoff = kirchhoff_tensor(cast.body.surface, cast.body.moments);
    }
    warn_of_added_mass(scene_body, *cast.body.kirchhoff);
    return cast;
}

void note(const std::string& text) {
    fmt::print(stderr, "samara simulate: note: {}\n", text);
}

/// Says where coefficients were held at an end of their tables.
void warn_of_reynolds_numbers(const SceneBody& scene_body, const Body& body, const FlightReport& report) {
    if (scene_body.loads != Loads::table && scene_body.turbulence != Turbulence::table) return;
    if (scene_body.table_reynolds_number) return;  // as the scene asks
    const double lowest = body.tables->reynolds_numbers.front();
    const double highest = body.tables->reynolds_numbers.back();
    // A table of one Reynolds number is made for the terminal speed: swings around it are expected.
    if (report.highest_reynolds_number > 2.0 * highest) {
        note(
            fmt::format("'{}' reached the Reynolds number {:.3g}, its table ends at {:.3g}: its last values "
                        "were held",
                        scene_body.name, report.highest_reynolds_number, highest));
    }
    const double share = share_below_table(report);
    if (scene_body.loads == Loads::table && share > 0.5) {
        note(fmt::format(
            "'{}' moved below half its table's lowest Reynolds number, {:.3g}, for {:.0f} % of its "
            "flight: there Stokes resistance is added to the table's first values",
            scene_body.name, lowest, 100.0 * share));
    }
}

void warn_of_substeps(const SimulationReport& report) {
    if (report.steps_at_limit == 0) return;
    note(
        fmt::format("in {} of {} steps a body turned so fast that {} substeps were too few for 0.3 rad "
                    "each; use a smaller step",
                    report.steps_at_limit, report.steps, most_substeps));
}

/// Chooses the models of the bodies that leave them to the advice, and says which; nothing where none does.
std::optional<ModelAdvice> choose_models(Scene& scene, const std::vector<CastBody>& cast, int threads) {
    bool any = false;
    for (std::size_t i = 0; i < cast.size(); ++i) {
        if (!scene.bodies[i].models_auto) continue;
        (void)make_immersed_body(cast[i].body, scene.bodies[i], scene.fluid);  // throws where tables lack
        any = true;
    }
    if (!any) return std::nullopt;
    AdviceOptions options;
    options.auto_alone = true;
    options.sampling.threads = threads;
    Progress progress("judging models", "flights");
    ModelAdvice advice =
        advise_models(scene, cast, options, [&](double done, double total) { progress.update(done, total); });
    apply(advice, scene);
    return advice;
}

/// Flies the scene into the motion file.
SimulationReport fly(Simulation& simulation, const std::string& output) {
    SimulationReport report;
    write_motion_file(output, simulation.motion(), [&](MotionWriter& writer) {
        Progress progress("simulating", "steps");
        report = simulation.fly([&](std::size_t body, std::size_t first,
                                    const std::vector<Pose>& poses) { writer.write(body, first, poses); },
                                [&](double done, double total) {
                                    progress.update(done, total);
                                    return !interrupted;
                                });
        writer.finish(report.frames);
    });
    if (report.interrupted) {
        throw Error(fmt::format("interrupted at {:g} of {:g} s: {} holds the {} frames until then",
                                simulation.motion().times[report.frames - 1],
                                simulation.motion().times.back(), output, report.frames));
    }
    return report;
}

nlohmann::json body_result(const MotionReader& file, std::size_t index, const BodyMeasures& measures,
                           const FlightReport& report, const std::optional<LoadTables>& tables) {
    const BodyMotion& body = file.motion().bodies[index];
    nlohmann::json result = as_json(measures);
    result["name"] = body.name;
    result["models"] = body.models;
    result["mean_descent_speed"] = measures.descent_speed;
    result["final_position"] = as_json(file.poses(index, {}).back().position);
    result["highest_reynolds_number"] = report.highest_reynolds_number;
    result["share_below_table"] = share_below_table(report);
    result["table_errors"] = table_errors_as_json(tables, report.table_errors);
    return result;
}

nlohmann::json run(const Request& request, const Arguments& arguments) {
    Scene scene = read_scene_file(request.scene);
    if (arguments.given("--seed")) scene.seed = request.seed;
    if (arguments.given("--step")) scene.step = request.step;

    std::vector<CastBody> cast;
    for (const SceneBody& body : scene.bodies) cast.push_back(cast_body(body, request.bodies));

    const std::optional<ModelAdvice> advice = choose_models(scene, cast, request.threads);
    if (advice && !arguments.json()) fmt::print("models = \"auto\" chose:\n{}", as_text(*advice));

    std::signal(SIGINT, note_interrupt);
    std::signal(SIGTERM, note_interrupt);
    Simulation simulation(scene, cast, request.runs, request.threads);
    const SimulationReport report = fly(simulation, request.output);
    std::signal(SIGINT, SIG_DFL);  // the file stands
    std::signal(SIGTERM, SIG_DFL);
    for (std::size_t i = 0; i < cast.size(); ++i) {
        warn_of_reynolds_numbers(scene.bodies[i], cast[i].body, report.bodies[i]);
        for (const std::string& warning :
             table_error_warnings(scene.bodies[i].name, report.bodies[i].table_errors)) {
            note(warning);
        }
    }
    warn_of_substeps(report);

    const MotionReader file(request.output);
    Progress progress("measuring", "poses");
    const std::vector<BodyMeasures> measures =
        measure_file(file, request.threads, [&](double done, double total) { progress.update(done, total); });
    nlohmann::json bodies = nlohmann::json::array();
    for (std::size_t i = 0; i < measures.size(); ++i) {
        bodies.push_back(body_result(file, i, measures[i], report.bodies[i], cast[i].body.tables));
        if (arguments.json()) continue;
        const BodyMotion& body = file.motion().bodies[i];
        fmt::print("{}\n{}  {}\n{}", body.name, as_text(measures[i]), body.models,
                   table_errors_as_text(cast[i].body.tables, report.bodies[i].table_errors));
    }
    const auto steps = static_cast<double>(report.steps);
    const double nanoseconds = steps > 0.0 ? 1e9 * report.seconds / steps : 0.0;
    if (!arguments.json()) {
        fmt::print("{} steps in {:.3g} s, {:.0f} ns each -> {}\n", report.steps, report.seconds, nanoseconds,
                   request.output);
    }
    return {{"bodies", bodies},
            {"models", advice ? as_json(*advice) : nlohmann::json(nullptr)},
            {"frames", report.frames},
            {"steps", report.steps},
            {"implicit_steps", report.implicit_steps},
            {"most_substeps", report.most_substeps},
            {"steps_at_limit", report.steps_at_limit},
            {"seconds", report.seconds},
            {"nanoseconds_per_step", nanoseconds},
            {"output", request.output}};
}

}  // namespace

int simulate_command(int argc, const char* const* argv) {
    Request request;
    Arguments arguments("samara simulate", "Simulates a scene and writes the motion of its bodies.");
    arguments.positional("SCENE", request.scene, "scene file (.toml; docs/scene-file.md lists its keys)");
    arguments.required_option("-o,--output", request.output, "motion file to write (.h5)");
    arguments.option(
        "--bodies", request.bodies,
        "folder of baked bodies, NAME.body.h5 for each body of the scene ('samara bake SCENE -o DIR')");
    arguments.option("--seed", request.seed, "seed of the noise, instead of the scene's");
    arguments.option("--step", request.step, "time step (s), instead of the scene's", 1e-9, 1e3);
    arguments.option("--runs", request.runs, "runs that differ by their noise alone", 1, 1'000'000);
    arguments.option("--threads", request.threads,
                     "threads, 0: all cores; the motion is the same for any number", 0, 4096);
    arguments.footer(
        "--json: bodies (a list with name, mean_velocity, mean_descent_speed, final_position, regime, and "
        "the\n"
        "figures of the ensemble of copies and runs: docs/output.md), steps, seconds, nanoseconds_per_step.\n"
        "Speeds in m/s over the last two thirds of the fall, angles in radians. An interrupt (Ctrl-C) "
        "leaves\n"
        "the frames flown so far as a motion file.\n");
    return run_program(argc, argv, arguments, [&] { return run(request, arguments); });
}

}  // namespace samara
