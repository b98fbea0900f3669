// samara search: a scene -> the seeds with which a body comes to a target.

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/commands/commands.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/prepared_scene.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/motion/motion_writer.hpp"
#include "samara/scene/scene_file.hpp"
#include "samara/scene/scene_simulation.hpp"
#include "samara/scene/target_search.hpp"

namespace samara {
namespace {

constexpr const char* program = "samara search";

struct Request {
    std::string scene;
    std::string target;
    std::string ring;
    std::string body;
    std::string bodies;
    std::string output;
    std::uint64_t seed = 0;
    int tries = 100;
    int threads = 0;
};

/// Finite numbers between commas, `count` of them.
std::vector<double> numbers_of(const std::string& option, const std::string& words, std::size_t count,
                               const char* form) {
    std::vector<double> numbers;
    const char* at = words.data();
    const char* const end = at + words.size();
    while (at != end) {
        double number = 0.0;
        const auto [after, error] = std::from_chars(at, end, number);
        if (error != std::errc() || !std::isfinite(number) || (after != end && *after != ',')) break;
        numbers.push_back(number);
        at = after == end ? end : after + 1;
        if (after != end && at == end) break;  // a comma at the end
    }
    if (at != end || numbers.size() != count || words.ends_with(',')) {
        throw Error(fmt::format("{} must be {} in metres, {} numbers separated by commas, not '{}'", option,
                                form, count, words));
    }
    return numbers;
}

Target target_of(const Request& request) {
    if (request.target.empty() == request.ring.empty()) {
        throw Error("give either --target x,y,z,radius or --ring x,y,z,nx,ny,nz,radius");
    }
    Target target;
    const bool is_ring = !request.ring.empty();
    const std::vector<double> numbers = is_ring
                                            ? numbers_of("--ring", request.ring, 7, "x,y,z,nx,ny,nz,radius")
                                            : numbers_of("--target", request.target, 4, "x,y,z,radius");
    target.middle = Vector3d(numbers.data());
    target.radius = numbers.back();
    if (!(target.radius > 0.0)) throw Error(fmt::format("the radius {} must be above 0", target.radius));
    if (!is_ring) return target;
    const Vector3d normal(&numbers[3]);
    if (!(normal.norm() > 0.0)) throw Error("--ring needs a normal nx,ny,nz that is not zero");
    target.normal = normal.normalized();
    return target;
}

std::size_t body_of(const Scene& scene, const std::string& name) {
    if (name.empty() && scene.bodies.size() == 1) return 0;
    std::string names;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (scene.bodies[i].name == name) return i;
        names += fmt::format("{}{}", i == 0 ? "" : ", ", scene.bodies[i].name);
    }
    throw Error(fmt::format("{}: give --body with one of its bodies: {}", scene.file.string(), names));
}

void write_best(const PreparedScene& prepared, const Request& request) {
    SceneSimulation simulation(prepared.scene, prepared.bodies, 1, request.threads);
    write_motion_file(request.output, simulation.motion(), [&](MotionWriter& writer) {
        Progress progress("writing the best", "steps");
        simulation.fly([&](std::size_t body, std::size_t first,
                           const std::vector<Pose>& poses) { writer.write(body, first, poses); },
                       [&](double done, double total) {
                           progress.update(done, total);
                           return true;
                       });
    });
}

nlohmann::json run(const Request& request, const Arguments& arguments) {
    if (!request.output.empty()) require_motion_file_name(request.output);
    const Target target = target_of(request);
    Scene read = read_scene_file(request.scene);
    const std::size_t body = body_of(read, request.body);
    Preparation preparation{.bodies = request.bodies, .threads = request.threads};
    if (arguments.given("--seed")) preparation.seed = request.seed;
    PreparedScene prepared = prepare_scene(std::move(read), preparation);
    Scene& scene = prepared.scene;
    if (request.tries > 1 && !depends_on_seed(scene, body)) {
        throw Error(fmt::format(
            "{}: the fall of '{}' does not depend on the seed; give the body a count with a spread, an "
            "emitter or turbulence, or the wind gusts without a seed, or run 'samara simulate'",
            request.scene, scene.bodies[body].name));
    }
    std::vector<TargetMiss> misses;
    {
        Progress progress("searching", "tries");
        misses = search_target(scene, prepared.bodies, body, target, request.tries, request.threads,
                               [&](double share) { progress.update(share * request.tries, request.tries); });
    }
    const auto reached =
        std::count_if(misses.begin(), misses.end(), [](const TargetMiss& miss) { return miss.reached; });
    constexpr std::size_t most_lines = 20;
    nlohmann::json tries = nlohmann::json::array();
    if (!arguments.json()) print_result("{:>20}  copy  distance, m   time, s\n", "seed");
    for (std::size_t i = 0; i < misses.size(); ++i) {
        const TargetMiss& miss = misses[i];
        tries.push_back({{"seed", miss.seed},
                         {"copy", miss.copy},
                         {"distance", miss.distance},
                         {"time", miss.time},
                         {"reached", miss.reached}});
        if (arguments.json() || i >= most_lines) continue;
        print_result("{:>20}  {:>4}  {:>11.4g}  {:>8.4g}  {}\n", miss.seed, miss.copy, miss.distance,
                     miss.time, miss.reached ? "reached" : "");
    }
    const TargetMiss& best = misses.front();
    if (reached == 0) {
        throw Error(fmt::format(
            "{}: none of {} tries reaches the target of radius {:g} m: the nearest, seed {}, stays {:.4g} m "
            "from its centre; give more --tries, a larger radius, or the scene a wider spread",
            request.scene, request.tries, target.radius, best.seed, best.distance));
    }
    if (!arguments.json()) {
        print_result(
            "{} of {} tries reach the target; simulate the best with 'samara simulate {} --seed {}'\n",
            reached, request.tries, request.scene, best.seed);
    }
    if (!request.output.empty()) {
        scene.seed = best.seed;
        write_best(prepared, request);
    }
    return {{"body", scene.bodies[body].name}, {"reached", reached}, {"tries", tries}};
}

}  // namespace

int search_command(int argc, const char* const* argv) {
    Request request;
    Arguments arguments(program, "Searches for seeds with which a body reaches a target or passes a ring.");
    arguments.positional("SCENE", request.scene,
                         "scene file (.toml; docs/reference/scene-file.md lists its keys)");
    arguments.option("--target", request.target,
                     "x,y,z,radius (m): a sphere that contains the body when the scene ends");
    arguments.option("--ring", request.ring,
                     "x,y,z,nx,ny,nz,radius (m): a ring with this normal that the body passes through");
    arguments.option("--body", request.body, "the body; required if the scene has several");
    arguments.option("--tries", request.tries, "number of seeds to try, counted up from the first", 1,
                     10'000'000);
    arguments.option("--seed", request.seed, "first seed; by default the scene's");
    arguments.output_option("-o,--output", request.output, "motion file (.h5) of the best try");
    arguments.option("--bodies", request.bodies,
                     "folder of baked bodies, NAME.body.h5 for each body of the scene");
    arguments.option("--threads", request.threads,
                     "number of threads, 0: all cores; the result does not depend on it", 0, 4096);
    arguments.footer(
        "The seed determines the noise; the starts, sizes and release times of bodies with a count above 1;\n"
        "the points of an emitter; and the wind's gusts that have no seed of their own. A scene that does "
        "not\n"
        "depend on the seed is rejected. The copy that comes nearest counts. --json: body, reached (how "
        "many),\n"
        "tries (seed, copy, distance, time, reached; the nearest first).\n");
    return run_program(argc, argv, arguments, [&] { return run(request, arguments); });
}

}  // namespace samara
