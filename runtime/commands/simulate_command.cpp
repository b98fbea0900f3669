// samara simulate: a scene -> a motion file.

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/analysis/advice/input_warnings.hpp"
#include "samara/analysis/metrics/description.hpp"
#include "samara/commands/commands.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/body_notes.hpp"
#include "samara/commands/shared/prepared_scene.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/commands/table_errors_report.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/kernel/body_state.hpp"
#include "samara/formats/json_text.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/motion/motion_writer.hpp"
#include "samara/scene/run_needs.hpp"
#include "samara/scene/scene_file.hpp"
#include "samara/scene/scene_simulation.hpp"

namespace samara {
namespace {

constexpr const char* program = "samara simulate";

struct Request {
    std::string scene;
    std::string output;
    std::string bodies;
    std::uint64_t seed = 0;
    double step = 0.0;
    int runs = 1;
    int threads = 0;
    bool forces = false;
};

std::atomic<bool> interrupted = false;

extern "C" void note_interrupt(int /*signal*/) {
    interrupted = true;
}

/// While it lives, what would end the program is noted instead, and the flight ends with a file. A signal
/// that is ignored, as nohup and a shell's background have it, stays so.
class NotedInterrupts {
  public:
    NotedInterrupts() {
        struct sigaction noting = {};
        noting.sa_handler = note_interrupt;
        noting.sa_flags = SA_RESTART;
        for (std::size_t i = 0; i < signals.size(); ++i) {
            ::sigaction(signals[i], nullptr, &before_[i]);
            if (before_[i].sa_handler != SIG_IGN) ::sigaction(signals[i], &noting, nullptr);
        }
    }
    ~NotedInterrupts() {
        for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &before_[i], nullptr);
    }
    NotedInterrupts(const NotedInterrupts&) = delete;
    NotedInterrupts& operator=(const NotedInterrupts&) = delete;

  private:
    static constexpr std::array signals = {SIGINT, SIGTERM, SIGHUP};
    std::array<struct sigaction, signals.size()> before_ = {};
};

void note(const std::string& text) {
    print_note("{}: warning: {}\n", program, text);
}

/// Notes before the simulation which values of the bodies make the motion uncertain.
void note_doubtful_bodies(const Scene& scene, const std::vector<LoadedBody>& loaded) {
    constexpr double doubtful = 0.2;
    BodyNotes notes(program);
    for (std::size_t i = 0; i < loaded.size(); ++i) {
        const SceneBody& body = scene.bodies[i];
        const std::string units = unit_warnings(*loaded[i].body, body.mass, scene.fluid, scene.gravity.norm(),
                                                scale_remedy_in_scene(body.shape));
        notes.add(units, body.name, 0.0, units);
        notes.add("shape", body.name, 0.0,
                  is_body_file_name(body.shape) ? "" : shape_warning(*loaded[i].body));
        if (body.loads == Loads::surface && body.open.loads && !loaded[i].body->tables &&
            !loaded[i].body->recommended) {
            notes.add("surface", body.name, 0.0,
                      "has no tables; its loads are estimated from potential flow "
                      "(docs/explanation/loads-without-a-bake.md); 'samara bake' computes tables");
        }
        const DensityWarning density = density_warning(body, *loaded[i].body, scene.fluid);
        notes.add("density", body.name, density.ratio, density.text);
        const double error = body.added_mass ? loaded[i].body->kirchhoff->error_estimate : 0.0;
        if (error <= doubtful) continue;
        notes.add("added mass", body.name, error,
                  fmt::format("the added mass may be off by {:.0f} % (error estimate): the body is thin or "
                              "its mesh is coarse",
                              100.0 * error));
    }
    notes.print();
}

/// Says where coefficients were held at an end of their tables.
void note_reynolds_numbers(BodyNotes& notes, const SceneBody& scene_body, const Body& body,
                           const BodyReport& report) {
    if (!uses_body_tables(scene_body.loads, scene_body.turbulence)) return;
    if (scene_body.table_reynolds_number) return;  // as the scene asks
    const double lowest = body.tables->reynolds_numbers.front();
    const double highest = body.tables->reynolds_numbers.back();
    // A table of one Reynolds number is made for the terminal speed: swings around it are expected.
    if (report.highest_reynolds_number > 2.0 * highest) {
        notes.add("above the table", scene_body.name, report.highest_reynolds_number / highest,
                  fmt::format("reached the Reynolds number {:.3g}, but its table ends at {:.3g}: the table's "
                              "last values were used",
                              report.highest_reynolds_number, highest));
    }
    const double share = report.share_below_table();
    if (scene_body.loads == Loads::table && share > 0.5) {
        notes.add("below the table", scene_body.name, share,
                  fmt::format("moved below half its table's lowest Reynolds number, {:.3g}, for {:.0f} % of "
                              "the time: there Stokes drag is added to the table's first values",
                              lowest, 100.0 * share));
    }
}

void warn_of_substeps(const SimulationReport& report) {
    if (report.steps_at_limit == 0) return;
    note(fmt::format(
        "in {} of {} steps a body rotated by more than 0.3 rad in each of {} substeps; use a smaller step",
        report.steps_at_limit, report.steps, most_substeps));
}

PreparedScene prepare_with_progress(Scene scene, const Preparation& preparation) {
    std::optional<Progress> progress;  // of the judging alone, without the time that loading takes
    return prepare_scene(std::move(scene), preparation, [&](double done, double total) {
        if (!progress) progress.emplace("judging models", "flights");
        progress->update(done, total);
    });
}

/// Says what a large run will take, and throws Error where the machine has no room for it.
void judge_needs(const RunNeeds& needs, const Request& request) {
    constexpr double large = 1e9;
    if (std::max(needs.memory, needs.disk) > large) note("takes about " + in_words(needs));
    require_room(needs, request.scene, request.output);
}

/// Flies the scene into the motion file.
SimulationReport fly(const Scene& scene, const std::vector<LoadedBody>& loaded, const Request& request) {
    const std::string& output = request.output;
    const NotedInterrupts interrupts;
    SceneSimulation simulation(scene, loaded, request.runs, request.threads, request.forces);
    SimulationReport report;
    write_motion_file(output, simulation.motion(), [&](MotionWriter& writer) {
        Progress progress("simulating", "steps");
        report = simulation.fly([&](const MotionBlock& block) { writer.write(block); },
                                [&](double done, double total) {
                                    progress.update(done, total);
                                    return !interrupted;
                                });
        writer.finish(report.frames, report.copies);
    });
    for (std::size_t i = 0; report.interrupted && i < scene.bodies.size(); ++i) {
        const auto copies = static_cast<std::size_t>(scene.bodies[i].count);
        if (report.copies[i] == copies) continue;
        throw Error(fmt::format("interrupted: {} holds the first {} of the {} copies of '{}', {} frames",
                                output, report.copies[i], copies, scene.bodies[i].name, report.frames));
    }
    if (report.interrupted) {
        throw Error(fmt::format("interrupted at {:g} of {:g} s: {} holds the first {} frames",
                                simulation.motion().times[report.frames - 1],
                                simulation.motion().times.back(), output, report.frames));
    }
    return report;
}

/// The tables whose errors are those of the flight; none where it was by others than its bake's.
std::optional<LoadTables> baked_tables(const SceneBody& scene_body, const Body& body) {
    return scene_body.loads == Loads::surface ? std::nullopt : body.tables;
}

nlohmann::json body_result(const MotionReader& file, std::size_t index, const BodyMeasures& measures,
                           const BodyReport& report, const std::optional<LoadTables>& tables) {
    const BodyMotion& body = file.motion().bodies[index];
    nlohmann::json result = as_json(measures);
    result["name"] = body.name;
    result["models"] = body.models;
    result["mean_descent_speed"] = measures.value(Metric::descent_speed);
    result["final_position"] = as_json(file.poses(index, {}).back().position);
    result["highest_reynolds_number"] = report.highest_reynolds_number;
    result["share_below_table"] = report.share_below_table();
    result["table_errors"] = table_errors_as_json(tables, report.table_errors);
    return result;
}

nlohmann::json step_as_json(const StepAdvice& advice) {
    return {{"error", advice.error},
            {"tolerance", advice.tolerance},
            {"within", advice.is_within},
            {"limit", advice.limit}};
}

nlohmann::json run(const Request& request, const Arguments& arguments) {
    require_motion_file_name(request.output);
    Scene read = read_scene_file(request.scene);
    judge_needs(needs_of(read, request.runs), request);

    Preparation preparation{.bodies = request.bodies, .threads = request.threads};
    if (arguments.given("--seed")) preparation.seed = request.seed;
    if (arguments.given("--step")) preparation.step = request.step;
    const auto [scene, loaded, advice, step] = prepare_with_progress(std::move(read), preparation);
    if (step && !arguments.json()) print_result("step = \"auto\": {}\n", as_text(*step));
    if (advice && !arguments.json()) print_result("models = \"auto\" chose:\n{}", as_text(*advice));
    const RunNeeds needs = needs_of(scene, request.runs, loaded);
    require_room(needs, request.scene, request.output);
    note_doubtful_bodies(scene, loaded);
    const SimulationReport report = fly(scene, loaded, request);
    BodyNotes notes(program);
    for (std::size_t i = 0; i < loaded.size(); ++i) {
        note_reynolds_numbers(notes, scene.bodies[i], *loaded[i].body, report.bodies[i]);
        if (scene.bodies[i].loads != Loads::surface) {  // whose errors are not of a bake
            note_table_errors(notes, scene.bodies[i].name, loaded[i].body->tables,
                              report.bodies[i].table_errors);
        }
    }
    notes.print();
    warn_of_substeps(report);

    const MotionReader file(request.output);
    Progress progress("measuring", "poses");
    const std::vector<BodyMeasures> measures =
        measure_file(file, request.threads, [&](double done, double total) { progress.update(done, total); });
    nlohmann::json bodies = nlohmann::json::array();
    for (std::size_t i = 0; i < measures.size(); ++i) {
        bodies.push_back(body_result(file, i, measures[i], report.bodies[i],
                                     baked_tables(scene.bodies[i], *loaded[i].body)));
        if (arguments.json()) continue;
        const BodyMotion& body = file.motion().bodies[i];
        print_result("{}\n{}  {}\n{}", body.name, as_text(measures[i]), body.models,
                     table_errors_as_text(baked_tables(scene.bodies[i], *loaded[i].body),
                                          report.bodies[i].table_errors));
    }
    const auto steps = static_cast<double>(report.steps);
    const double nanoseconds = steps > 0.0 ? 1e9 * report.seconds / steps : 0.0;
    if (!arguments.json()) {
        print_result("{} steps in {:.3g} s, {:.0f} ns each -> {}\n", report.steps, report.seconds,
                     nanoseconds, request.output);
    }
    return {
        {"bodies", bodies},
        {"models", advice ? as_json(*advice) : nlohmann::json(nullptr)},
        {"step", {{"seconds", scene.step}, {"auto", step ? step_as_json(*step) : nlohmann::json(nullptr)}}},
        {"needs", {{"memory", needs.memory}, {"disk", needs.disk}}},
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
    Arguments arguments(program, "Simulates a scene and writes the motion of its bodies.");
    arguments.positional("SCENE", request.scene,
                         "scene file (.toml; docs/reference/scene-file.md lists its keys)");
    arguments.required_output_option("-o,--output", request.output, "motion file to write (.h5)");
    arguments.option(
        "--bodies", request.bodies,
        "folder of baked bodies, NAME.body.h5 for each body of the scene ('samara bake SCENE -o DIR')");
    arguments.option("--seed", request.seed, "seed of the noise; by default the scene's");
    arguments.option("--step", request.step, "time step (s); by default the scene's", 1e-9, 1e3);
    arguments.option("--runs", request.runs, "number of runs, which differ only in their noise", 1,
                     1'000'000);
    arguments.flag(
        "--forces", request.forces,
        "keeps the fluid's forces of each frame by their causes: buoyancy, inertia, drag, lift, noise");
    arguments.option("--threads", request.threads,
                     "number of threads, 0: all cores; the result does not depend on it", 0, 4096);
    arguments.footer(
        "--json: bodies (a list with name, mean_velocity, mean_descent_speed, final_position, regime, and "
        "the\n"
        "metrics of the ensemble of copies and runs: docs/reference/output.md), steps, seconds, "
        "nanoseconds_per_step.\n"
        "Speeds in m/s over the last two thirds of the fall, angles in radians. An interrupt (Ctrl-C) "
        "writes\n"
        "the frames simulated so far as a motion file.\n");
    return run_program(argc, argv, arguments, [&] { return run(request, arguments); });
}

}  // namespace samara
