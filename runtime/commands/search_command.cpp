// samara search: a scene -> the seeds and launches with which a body reaches what the user asks for.

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "samara/commands/commands.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/prepared_scene.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/motion/motion_writer.hpp"
#include "samara/scene/motion_search.hpp"
#include "samara/scene/scene_file.hpp"
#include "samara/scene/scene_simulation.hpp"

namespace samara {
namespace {

constexpr const char* program = "samara search";
constexpr double degree = std::numbers::pi / 180.0;

struct Request {
    std::string scene;
    std::string target;
    std::string ring;
    std::string up;
    double up_within = 30.0;
    std::string landing_time;
    std::string speed;
    double direction_within = 0.0;
    double orientation_within = 0.0;
    std::string position_within;
    std::string body;
    std::string bodies;
    std::string output;
    std::uint64_t seed = 0;
    int tries = 100;
    int threads = 0;
};

/// Finite numbers between commas; none where the words are something else.
std::vector<double> numbers_in(const std::string& words) {
    std::vector<double> numbers;
    const char* at = words.data();
    const char* const end = at + words.size();
    while (true) {
        double number = 0.0;
        const auto [after, error] = std::from_chars(at, end, number);
        if (error != std::errc() || !std::isfinite(number)) return {};
        numbers.push_back(number);
        if (after == end) return numbers;
        if (*after != ',') return {};
        at = after + 1;
    }
}

/// The numbers of an option, as many as one of its forms has.
std::vector<double> numbers_of(const std::string& option, const std::string& words,
                               const std::vector<std::string>& forms) {
    std::vector<double> numbers = numbers_in(words);
    for (const std::string& form : forms) {
        if (static_cast<std::size_t>(std::count(form.begin(), form.end(), ',')) + 1 == numbers.size())
            return numbers;
    }
    throw Error(fmt::format("{} must be numbers without units, {}, not '{}'", option,
                            fmt::join(forms, " or "), words));
}

double positive(const std::string& option, const char* what, double number) {
    if (number > 0.0) return number;
    throw Error(fmt::format("{}: the {} {} must be above 0", option, what, number));
}

Vector3d up_axis(const std::string& words) {
    const bool down = words.starts_with('-');
    const std::string letter = words.substr(down ? 1 : 0);
    if (letter == "x" || letter == "y" || letter == "z") {
        return (down ? -1.0 : 1.0) * Vector3d::Unit(letter.front() - 'x');
    }
    const std::vector<double> numbers = numbers_in(words);
    if (numbers.size() != 3 || Vector3d(numbers.data()).isZero(0.0)) {
        throw Error(fmt::format("--up must be x, -x, y, -y, z, -z or a vector x,y,z, not '{}'", words));
    }
    return Vector3d(numbers.data()).normalized();
}

SearchGoals goals_of(const Request& request) {
    SearchGoals goals;
    if (!request.target.empty()) {
        const std::vector<double> numbers =
            numbers_of("--target", request.target, {"x,y,z,radius in metres"});
        goals.target = {Vector3d(numbers.data()), positive("--target", "radius", numbers[3])};
    }
    if (!request.ring.empty()) {
        const std::vector<double> numbers = numbers_of(
            "--ring", request.ring, {"x,y,z,radius in metres", "x,y,z,nx,ny,nz,radius with a normal"});
        goals.ring = RingGoal{.middle = Vector3d(numbers.data()),
                              .radius = positive("--ring", "radius", numbers.back())};
        if (numbers.size() == 7) {
            const Vector3d normal(&numbers[3]);
            if (normal.isZero(0.0)) throw Error("--ring needs a normal nx,ny,nz that is not zero");
            goals.ring->normal = normal.normalized();
        }
    }
    if (!request.up.empty()) goals.up = {up_axis(request.up), degree * request.up_within};
    if (!request.landing_time.empty()) {
        const std::vector<double> numbers =
            numbers_of("--landing-time", request.landing_time, {"time,tolerance in seconds"});
        goals.landing = {numbers[0], positive("--landing-time", "tolerance", numbers[1])};
    }
    if (!goals.any()) throw Error("give a goal: --target, --ring, --up or --landing-time");
    return goals;
}

LaunchRanges launch_of(const Request& request) {
    LaunchRanges launch{.direction_within = degree * request.direction_within,
                        .orientation_within = degree * request.orientation_within};
    if (!request.speed.empty()) {
        const std::vector<double> numbers = numbers_of("--speed", request.speed, {"lowest,highest in m/s"});
        launch.speed = {numbers[0], numbers[1]};
        if (numbers[0] < 0.0 || numbers[1] < numbers[0]) {
            throw Error(fmt::format("--speed must be the lowest and the highest, 0 or more, not '{}'",
                                    request.speed));
        }
    }
    if (!request.position_within.empty()) {
        const std::vector<double> numbers =
            numbers_of("--position-within", request.position_within, {"x,y,z in metres"});
        launch.position_within = Vector3d(numbers.data());
        if (launch.position_within.minCoeff() < 0.0) {
            throw Error(
                fmt::format("--position-within must be 0 or more, not '{}'", request.position_within));
        }
    }
    return launch;
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

void write_motion(const Scene& scene, const std::vector<LoadedBody>& bodies, const Request& request) {
    SceneSimulation simulation(scene, bodies, 1, request.threads);
    write_motion_file(request.output, simulation.motion(), [&](MotionWriter& writer) {
        Progress progress("writing the best", "steps");
        simulation.fly([&](const MotionBlock& block) { writer.write(block); },
                       [&](double done, double total) {
                           progress.update(done, total);
                           return true;
                       });
    });
}

/// Throws where the goals and ranges cannot be those of the scene.
void require_search(const Scene& scene, const MotionSearch& search, const Request& request) {
    const SceneBody& body = scene.bodies[search.body];
    require_launch(search.launch, body);
    if (search.goals.landing && !scene.ground && scene.obstacles.empty()) {
        throw Error(fmt::format(
            "{}: has neither ground nor an obstacle to land on; add one, or leave --landing-time out",
            request.scene));
    }
    if (search.tries == 1 || search.launch.any() || depends_on_seed(scene, search.body)) return;
    throw Error(fmt::format(
        "{}: the fall of '{}' does not depend on the seed; give a range (--speed, --direction-within, "
        "--orientation-within, --position-within), or the body a count with a spread, an emitter or "
        "turbulence",
        request.scene, body.name));
}

/// A goal of the search with what a try came to.
struct GoalColumn {
    const char* name;  ///< as in JSON
    const char* title;
    const char* unit;
    std::optional<double> GoalMiss::*value;
    double scale;  ///< of the unit
};

std::vector<GoalColumn> columns_of(const SearchGoals& goals) {
    std::vector<GoalColumn> columns;
    if (goals.target) columns.push_back({"distance", "distance", "m", &GoalMiss::target, 1.0});
    if (goals.ring) {
        columns.push_back({"ring_distance", "ring", "m", &GoalMiss::ring, 1.0});
        columns.push_back({"ring_time", "at", "s", &GoalMiss::ring_time, 1.0});
    }
    if (goals.up) columns.push_back({"up_angle", "up", "deg", &GoalMiss::up, degree});
    if (goals.landing) columns.push_back({"landing_time", "lands", "s", &GoalMiss::landing, 1.0});
    return columns;
}

std::string value_of(const GoalColumn& column, const GoalMiss& miss) {
    const std::optional<double>& value = miss.*column.value;
    return value ? fmt::format("{:.4g}", *value / column.scale) : "never";
}

void print_tries(const std::vector<SearchTry>& tries, const std::vector<GoalColumn>& columns) {
    constexpr std::size_t most_lines = 20;
    std::string text = fmt::format("{:>20}  copy  {:>8}", "seed", "score");
    for (const GoalColumn& column : columns)
        text += fmt::format("  {:>11}", fmt::format("{}, {}", column.title, column.unit));
    for (std::size_t i = 0; i < tries.size() && i < most_lines && tries[i].error.empty(); ++i) {
        const GoalMiss& miss = tries[i].miss;
        text += fmt::format("\n{:>20}  {:>4}  {:>8.4g}", tries[i].seed, miss.copy, miss.score);
        for (const GoalColumn& column : columns) text += fmt::format("  {:>11}", value_of(column, miss));
        if (miss.reached()) text += "  reached";
    }
    print_result("{}\n", text);
}

nlohmann::json json_of(const Launch& launch) {
    nlohmann::json json = nlohmann::json::object();
    const auto add = [&](const char* key, const std::optional<Vector3d>& vector) {
        if (vector) json[key] = {vector->x(), vector->y(), vector->z()};
    };
    add("position", launch.position);
    if (launch.orientation) json["orientation"] = *launch.orientation;
    add("velocity", launch.velocity);
    return json;
}

nlohmann::json json_of(const std::vector<SearchTry>& tries, const std::vector<GoalColumn>& columns) {
    nlohmann::json json = nlohmann::json::array();
    for (const SearchTry& one : tries) {
        if (!one.error.empty()) continue;
        json.push_back({{"seed", one.seed},
                        {"copy", one.miss.copy},
                        {"score", one.miss.score},
                        {"reached", one.miss.reached()},
                        {"launch", json_of(one.launch)}});
        for (const GoalColumn& column : columns) {
            const std::optional<double>& value = one.miss.*column.value;
            json.back()[column.name] = value ? nlohmann::json(*value) : nlohmann::json();
        }
    }
    return json;
}

/// Prints what gives the best try, as lines of the scene file.
void print_best(const Scene& scene, const MotionSearch& search, const SearchTry& best, const Request& request,
                bool has_auto_step) {
    if (!search.launch.any()) {
        print_result("simulate the best with 'samara simulate {} --seed {}'\n", request.scene, best.seed);
        return;
    }
    print_result("The best is that of these values:\n\n[scene]\nseed = {}\n", best.seed);
    if (has_auto_step) print_result("step = {}\n", scene.step);
    print_result("\n[[body]]\nname = \"{}\"\n", scene.bodies[search.body].name);
    const nlohmann::json launch = json_of(best.launch);
    for (const auto& [key, values] : launch.items())
        print_result("{} = [{:.6g}]\n", key, fmt::join(values.get<std::vector<double>>(), ", "));
}

nlohmann::json run(const Request& request, const Arguments& arguments) {
    if (!request.output.empty()) require_motion_file_name(request.output);
    MotionSearch search{.goals = goals_of(request),
                        .launch = launch_of(request),
                        .tries = request.tries,
                        .threads = request.threads};
    Scene read = read_scene_file(request.scene);
    search.body = body_of(read, request.body);
    const bool has_auto_step = read.step_auto;
    Preparation preparation{.bodies = request.bodies, .threads = request.threads};
    if (arguments.given("--seed")) preparation.seed = request.seed;
    const PreparedScene prepared = prepare_scene(std::move(read), preparation);
    const Scene& scene = prepared.scene;
    require_search(scene, search, request);
    std::vector<SearchTry> tries;
    {
        Progress progress("searching", "tries");
        tries = search_motion(scene, prepared.bodies, search,
                              [&](double share) { progress.update(share * request.tries, request.tries); });
    }
    const auto failed =
        std::find_if(tries.begin(), tries.end(), [](const SearchTry& one) { return !one.error.empty(); });
    if (failed != tries.end()) {
        print_note("{}: warning: {} of {} tries cannot be simulated: {}", program, tries.end() - failed,
                   request.tries, failed->error);
    }
    const auto reached =
        std::count_if(tries.begin(), tries.end(), [](const SearchTry& one) { return one.miss.reached(); });
    const std::vector<GoalColumn> columns = columns_of(search.goals);
    if (!arguments.json()) print_tries(tries, columns);
    const SearchTry& best = tries.front();
    if (reached == 0) {
        std::string came;
        for (const GoalColumn& column : columns) {
            came += fmt::format("; {} {} {}", column.title, value_of(column, best.miss), column.unit);
        }
        throw Error(
            fmt::format("{}: none of {} tries reaches the goals: the nearest, seed {}, has a score of "
                        "{:.4g}, and 1 would be enough{}; "
                        "give more --tries, wider ranges, or larger tolerances",
                        request.scene, request.tries, best.seed, best.miss.score, came));
    }
    if (!arguments.json()) {
        print_result("{} of {} tries reach the goals\n", reached, request.tries);
        print_best(scene, search, best, request, has_auto_step);
    }
    if (!request.output.empty())
        write_motion(scene_of_try(scene, search.body, best), prepared.bodies, request);
    return {{"body", scene.bodies[search.body].name},
            {"step", scene.step},
            {"reached", reached},
            {"tries", json_of(tries, columns)}};
}

}  // namespace

int search_command(int argc, const char* const* argv) {
    Request request;
    Arguments arguments(program,
                        "Searches for seeds and launches with which a body lands where and how it shall.");
    arguments.positional("SCENE", request.scene,
                         "scene file (.toml; docs/reference/scene-file.md lists its keys)");
    arguments.option("--target", request.target,
                     "x,y,z,radius (m): a ball that contains the body when the scene ends");
    arguments.option("--ring", request.ring,
                     "x,y,z,radius or x,y,z,nx,ny,nz,radius (m): a ring, level or with that normal, that the "
                     "body passes through");
    arguments.option(
        "--up", request.up,
        "x, -x, y, -y, z, -z or x,y,z: the axis of the shape that points up when the scene ends");
    arguments.option("--up-within", request.up_within, "largest angle of --up from the vertical, degrees",
                     0.1, 180.0);
    arguments.option("--landing-time", request.landing_time,
                     "time,tolerance (s): when the body first touches the ground or an obstacle");
    arguments.option("--speed", request.speed, "lowest,highest (m/s): range of the launch's speed");
    arguments.option("--direction-within", request.direction_within,
                     "vary the direction of the launch by up to this, degrees", 0.0, 180.0);
    arguments.option("--orientation-within", request.orientation_within,
                     "rotate the body at its launch by up to this about a random axis, degrees", 0.0, 180.0);
    arguments.option("--position-within", request.position_within,
                     "x,y,z (m): shift the launch by up to this along each axis");
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
        "All goals must hold for one copy. The seed determines the launch within the ranges; the noise; the\n"
        "starts, sizes and release times of bodies with a count above 1; the points of an emitter; and the\n"
        "wind's gusts that have no seed of their own. A scene in which nothing varies is rejected. --json:\n"
        "body, step, reached (how many), tries (the best first: seed, copy, score, reached, launch, and "
        "what\n"
        "each goal came to).\n");
    return run_program(argc, argv, arguments, [&] { return run(request, arguments); });
}

}  // namespace samara
