// samara simulate: a scene -> a motion file.

#include <atomic>
#include <csignal>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands/commands.hpp"
#include "samara/base/content_hash.hpp"
#include "samara/base/error.hpp"
#include "samara/base/vector_json.hpp"
#include "samara/body/body_file.hpp"
#include "samara/command/arguments.hpp"
#include "samara/command/load_body.hpp"
#include "samara/command/progress.hpp"
#include "samara/kirchhoff/kirchhoff_solver.hpp"
#include "samara/motion/measures.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/scene/scene_file.hpp"
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
    if (!cast.body.kirchhoff) {
        cast.body.kirchhoff = kirchhoff_tensor(cast.body.surface, cast.body.moments);
    }
    warn_of_added_mass(scene_body, *cast.body.kirchhoff);
    return cast;
}

void warn_of_reynolds_numbers(const Scene& scene, const std::vector<CastBody>& cast,
                              const SimulationReport& report) {
    for (std::size_t i = 0; i < cast.size(); ++i) {
        const bool uses_tables =
            scene.bodies[i].loads == Loads::table || scene.bodies[i].turbulence == Turbulence::table;
        if (!uses_tables) continue;
        const double highest = cast[i].body.tables->reynolds_numbers.back();
        // A table of one Reynolds number is made for the terminal speed: swings around it are expected.
        if (report.highest_reynolds_number[i] > 2.0 * highest) {
            fmt::print(
                stderr,
                "samara simulate: note: '{}' reached the Reynolds number {:.3g}, its table ends at {:.3g}: "
                "its last values were held\n",
                scene.bodies[i].name, report.highest_reynolds_number[i], highest);
        }
    }
}

nlohmann::json body_result(const Motion& motion, const BodyMotion& body) {
    const BodyMeasures measures = measure_all(motion, body);
    return {{"name", body.name},
            {"mean_velocity", as_json(measures.mean_velocity)},
            {"mean_descent_speed", measures.descent_speed},
            {"descent_speed_deviation", measures.descent_speed_deviation},
            {"final_position", as_json(motion.pose(body, 0, motion.frames() - 1, 0).position)},
            {"inclination_amplitude", measures.inclination_amplitude},
            {"frequency", measures.frequency ? nlohmann::json(*measures.frequency) : nlohmann::json()},
            {"rms_angular_speed", measures.rms_angular_speed},
            {"regime", name_of(measures.regime)},
            {"regime_share", measures.regime_share},
            {"models", body.models}};
}

void print_body(const nlohmann::json& body) {
    constexpr double degrees = 180.0 / 3.14159265358979323846;
    fmt::print("{}: {}, descends at {:.4g} m/s, inclination up to {:.3g} degrees",
               body["name"].get<std::string>(), body["regime"].get<std::string>(),
               body["mean_descent_speed"].get<double>(),
               degrees * body["inclination_amplitude"].get<double>());
    if (!body["frequency"].is_null()) fmt::print(", {:.3g} Hz", body["frequency"].get<double>());
    fmt::print("\n  {}\n", body["models"].get<std::string>());
}

nlohmann::json run(const Request& request, const Arguments& arguments) {
    Scene scene = read_scene_file(request.scene);
    if (arguments.given("--seed")) scene.seed = request.seed;
    if (arguments.given("--step")) scene.step = request.step;

    std::vector<CastBody> cast;
    for (const SceneBody& body : scene.bodies) cast.push_back(cast_body(body, request.bodies));

    std::signal(SIGINT, note_interrupt);
    std::signal(SIGTERM, note_interrupt);
    SimulationResult result;
    {
        Progress progress("simulating", "steps");
        result = simulate(scene, cast, request.runs, [&](double done, double total) {
            progress.update(done, total);
            return !interrupted;
        });
    }
    write_motion_file(request.output, result.motion);
    warn_of_reynolds_numbers(scene, cast, result.report);

    nlohmann::json bodies = nlohmann::json::array();
    for (const BodyMotion& body : result.motion.bodies) bodies.push_back(body_result(result.motion, body));
    const auto steps = static_cast<double>(result.report.steps);
    const double nanoseconds = steps > 0.0 ? 1e9 * result.report.seconds / steps : 0.0;
    if (!arguments.json()) {
        for (const auto& body : bodies) print_body(body);
        fmt::print("{} steps in {:.3g} s, {:.0f} ns each -> {}\n", result.report.steps, result.report.seconds,
                   nanoseconds, request.output);
    }
    return {{"bodies", bodies},
            {"steps", result.report.steps},
            {"implicit_steps", result.report.implicit_steps},
            {"most_substeps", result.report.most_substeps},
            {"seconds", result.report.seconds},
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
    arguments.footer(
        "--json: bodies (a list with name, mean_velocity, mean_descent_speed, final_position, regime, ...), "
        "steps,\n"
        "seconds, nanoseconds_per_step. Speeds in m/s over the last two thirds of the fall, angles in "
        "radians.\n");
    return run_program(argc, argv, arguments, [&] { return run(request, arguments); });
}

}  // namespace samara
