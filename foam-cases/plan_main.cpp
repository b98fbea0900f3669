// The program samara-plan: plans the bake of a scene.

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "foam-cases/bake/bake.hpp"
#include "foam-cases/bake/bake_report.hpp"
#include "foam-cases/scene/scene_plan_report.hpp"
#include "samara/analysis/advice/input_warnings.hpp"
#include "samara/analysis/advice/model_advice.hpp"
#include "samara/analysis/advice/model_judgement.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/formats/json_text.hpp"
#include "samara/pictures/draw.hpp"
#include "samara/scene/scene_file.hpp"

namespace samara {
namespace {

struct PlanOptions {
    std::string scene;
    std::string bodies;
    std::string picture;
    std::string quality = usual_quality;
    double tolerance = SceneBakeOptions().tolerance;
};

nlohmann::json visits_as_json(const std::vector<VisitedDirection>& places) {
    nlohmann::json list = nlohmann::json::array();
    for (const VisitedDirection& place : places) {
        list.push_back({{"direction", as_json(place.direction)},
                        {"share", place.share},
                        {"load_share", place.load_share},
                        {"reynolds_numbers", {place.lowest_reynolds_number, place.highest_reynolds_number}},
                        {"images", place.images},
                        {"solved", place.solved}});
    }
    return list;
}

void print_places(const std::vector<VisitedDirection>& places) {
    print_result("{:>26} {:>6} {:>6} {:>20} {:>7}\n", "direction (map axes)", "time", "load",
                 "Reynolds numbers", "images");
    constexpr std::size_t most_rows = 20;
    for (std::size_t i = 0; i < std::min(places.size(), most_rows); ++i) {
        const VisitedDirection& place = places[i];
        const std::string range =
            place.share > 0.0
                ? fmt::format("{:.0f} to {:.0f}", place.lowest_reynolds_number, place.highest_reynolds_number)
                : "-";
        print_result("({:7.4f} {:7.4f} {:7.4f}) {:5.1f}% {:5.1f}% {:>20} {:>7}{}\n", place.direction.x(),
                     place.direction.y(), place.direction.z(), 100.0 * place.share, 100.0 * place.load_share,
                     range, place.images, place.solved ? "  case" : "");
    }
    if (places.size() > most_rows) print_result("and {} more\n", places.size() - most_rows);
}

nlohmann::json plan_body(const BakeRequest& request, const BakePreparation& preparation,
                         const PlanOptions& options, bool quiet, nlohmann::json& picture) {
    nlohmann::json json = bake_as_json(request, preparation);
    json["name"] = request.name;
    if (!preparation.scene_plan) {
        if (!quiet)
            print_result("{}: uses no tables: only mesh and Kirchhoff tensor, no CFD\n", request.name);
        return json;
    }
    const ScenePlan& plan = *preparation.scene_plan;
    const std::vector<VisitedDirection> places =
        visited_directions(preparation.simulation.visits, preparation.body.symmetry, plan);
    const RegimeCounts regimes = preparation.simulation.regimes();
    json["regime"] = name_of(regimes.commonest());
    json["visited"] = visits_as_json(places);
    json["whole_grid"] = cost_as_json(whole_grid(plan, false));
    json["symmetric_grid"] = cost_as_json(whole_grid(plan, true));
    picture = plan_picture(request.name, preparation.simulation.visits, preparation.body.symmetry, plan);
    if (quiet) return json;
    const GridCost all = whole_grid(plan, false);
    const GridCost wedge = whole_grid(plan, true);
    print_result("{}: with estimated loads the body is {} ({:.0f} % of the falls)\n", request.name,
                 name_of(regimes.commonest()), 100.0 * regimes.share(regimes.commonest()));
    print_places(places);
    print_result(
        "first round: {} directions at Reynolds number {:.6g}, {} cases, about {:.0f} CPU s; further rounds "
        "until\n"
        "the descent speed is certain to {:.3g} %\n",
        plan.chosen.size(), fmt::join(plan.cases.reynolds_numbers(), ", "), plan.cases.cases.size(),
        plan.cases.cpu_seconds, 100.0 * options.tolerance);
    print_result("all directions of that spacing: {} ({:.0f} CPU s), {} after symmetry ({:.0f} CPU s)\n\n",
                 all.directions, all.cpu_seconds, wedge.directions, wedge.cpu_seconds);
    return json;
}

/// What a body of the scene is simulated by as its file is, and how far such bodies are off.
struct Outlook {
    std::string models;
    std::string quality;  ///< of the tables, or "surface"; empty where the loads are of neither
    std::string origin;   ///< what the models were judged by; empty where the file recommends none
    std::optional<FallErrors> errors;
};

Outlook outlook_of(const SceneBody& scene_body, const Body& body) {
    SceneBody chosen = scene_body;
    choose_open_models(body, scene_body.open, chosen);
    if (scene_body.open.loads && chosen.loads == Loads::table && !body.tables) {
        chosen.loads = Loads::surface;  // which a simulation makes of any shape
        if (scene_body.open.turbulence) chosen.turbulence = Turbulence::none;
    }
    if (chosen.loads == Loads::table && !body.tables) {
        return {.models = "loads of tables, which its file does not hold",
                .quality = {},
                .origin = {},
                .errors = {}};
    }
    Outlook outlook{.models = in_words({chosen.loads, chosen.patches, chosen.turbulence}),
                    .quality = {},
                    .origin = {},
                    .errors = {}};
    if (chosen.loads == Loads::surface) outlook.quality = "surface";
    if (chosen.loads == Loads::table && body.tables) outlook.quality = body.tables->quality;
    if (scene_body.open.loads && body.recommended) outlook.origin = body.recommended->origin;
    if (outlook.origin.empty()) outlook.errors = errors_on_held_out_falls(outlook.quality);
    return outlook;
}

std::string in_words(const FallErrors& errors) {
    return fmt::format("off by {:.0f} % of the descent and {:.0f} % of the worst metric on held-out falls",
                       100.0 * errors.descent, 100.0 * errors.worst_metric);
}

/// Returns the lines that say what to expect of a body, and what would be better.
std::string as_text(const std::string& name, const Outlook& outlook, const BakePreparation& preparation,
                    const std::string& quality) {
    std::string text = fmt::format("  {}: {}", name, outlook.models);
    if (!outlook.origin.empty()) text += fmt::format(", as its file recommends ({})", outlook.origin);
    if (outlook.errors) text += "; such bodies are " + in_words(*outlook.errors);
    text += '\n';
    const auto after = errors_on_held_out_falls(quality);
    const bool is_better = after && (!outlook.errors || after->worst_metric < outlook.errors->worst_metric) &&
                           outlook.quality != "high";
    if (outlook.origin.empty() && is_better && preparation.plan) {
        text += fmt::format("    a {} bake costs {:.0f} CPU s in its first round; then they are {}\n",
                            quality, preparation.plan->cpu_seconds, in_words(*after));
    }
    return text;
}

nlohmann::json as_json(const std::string& name, const Outlook& outlook) {
    nlohmann::json json = {
        {"name", name},
        {"models", outlook.models},
        {"origin", outlook.origin.empty() ? nlohmann::json() : nlohmann::json(outlook.origin)},
        {"descent_error", nullptr},
        {"worst_metric_error", nullptr}};
    if (!outlook.errors) return json;
    json["descent_error"] = outlook.errors->descent;
    json["worst_metric_error"] = outlook.errors->worst_metric;
    return json;
}

/// Returns the command that follows: the bake, where a body uses tables and none were given, or the
/// simulation.
std::string next_command(const PlanOptions& options, const nlohmann::json& bodies) {
    const bool uses_tables = std::any_of(bodies.begin(), bodies.end(),
                                         [](const nlohmann::json& body) { return body.contains("regime"); });
    if (!options.bodies.empty()) {
        return fmt::format("samara simulate {} --bodies {} -o motion.h5", options.scene, options.bodies);
    }
    if (!uses_tables) return fmt::format("samara simulate {} -o motion.h5", options.scene);
    return fmt::format("samara bake {} -o bodies{}", options.scene,
                       options.quality == usual_quality ? "" : " --quality " + options.quality);
}

/// Returns the body for the model advice: the baked one where there is one.
LoadedBody as_baked(const BakeRequest& request, const BakePreparation& preparation, bool has_bodies) {
    if (has_bodies && std::filesystem::exists(request.output)) return {read_body_file(request.output), ""};
    return {preparation.body, ""};
}

ModelAdvice advised(const Scene& scene, const std::vector<LoadedBody>& loaded, double tolerance) {
    Progress progress("judging the physics", "simulations");
    AdviceOptions options;
    options.tolerance = tolerance;
    return advise_models(scene, loaded, options,
                         [&](double done, double total) { progress.update(done, total); });
}

nlohmann::json run(const PlanOptions& options, const Arguments& arguments) {
    if (std::filesystem::path(options.scene).extension() != ".toml") {
        throw Error(
            fmt::format("{0}: a plan needs a scene (.toml); 'samara bake {0} -o NAME.body.h5 --dry-run' "
                        "reports the cost of baking a shape in all directions",
                        options.scene));
    }
    Scene scene = read_scene_file(options.scene);
    if (!options.picture.empty()) {
        require_picture_format(options.picture);
        if (scene.bodies.size() != 1) {
            throw Error(
                fmt::format("{}: has {} bodies, but a picture shows one; leave the picture out, or give a "
                            "scene with one body",
                            options.scene, scene.bodies.size()));
        }
    }
    const std::filesystem::path folder = options.bodies.empty() ? "." : options.bodies;
    SceneBakeOptions wanted;
    wanted.quality = with_loads_by(usual_loads_closure(options.quality), bake_quality(options.quality));
    wanted.tolerance = options.tolerance;
    nlohmann::json result = {{"bodies", nlohmann::json::array()}, {"outlook", nlohmann::json::array()}};
    std::string outlooks;
    nlohmann::json picture;
    std::vector<LoadedBody> loaded;
    BodyNotes notes("samara plan");
    for (const BakeRequest& request : requests_for_scene(scene, folder, wanted)) {
        const BakePreparation preparation = prepare_bake(request);
        note_warnings(notes, request, preparation);
        result["bodies"].push_back(plan_body(request, preparation, options, arguments.json(), picture));
        loaded.push_back(as_baked(request, preparation, !options.bodies.empty()));
        SceneBody& body = scene.bodies[loaded.size() - 1];
        const Outlook outlook = outlook_of(body, *loaded.back().body);
        outlooks += as_text(body.name, outlook, preparation, options.quality);
        result["outlook"].push_back(as_json(body.name, outlook));
        if (loaded.back().body->recommended) choose_open_models(*loaded.back().body, body.open, body);
        const DensityWarning density = density_warning(body, *loaded.back().body, scene.fluid);
        notes.add("density", body.name, density.ratio, density.text);
    }
    notes.print();
    const ModelAdvice advice = advised(scene, loaded, options.tolerance);
    if (!arguments.json()) {
        print_result("{}\nwhat the bodies are simulated by now\n{}next: {}\n", as_text(advice), outlooks,
                     next_command(options, result["bodies"]));
    }
    result["models"] = as_json(advice);
    if (!options.picture.empty() && !picture.is_null()) draw_picture(options.picture, picture);
    return result;
}

}  // namespace
}  // namespace samara

int main(int argc, char** argv) {
    using namespace samara;
    PlanOptions options;
    Arguments arguments("samara plan",
                        "Shows what a scene needs: the directions and Reynolds numbers that its bodies "
                        "reach, and the first cases of a bake");
    arguments.positional("SCENE", options.scene, "scene file (.toml)");
    arguments.option("--bodies", options.bodies,
                     "folder of an earlier bake: its tensors are reused, and its tables determine which "
                     "physics the scene needs");
    arguments.option(
        "--picture", options.picture,
        "picture of the visited directions and the cases (.png or .svg; for a scene with one body)");
    arguments.choice("--quality", options.quality, bake_quality_names(), "quality of the planned bake");
    arguments.option(
        "--tolerance", options.tolerance,
        "tolerance of the descent speed, relative: for the planned bake, and for what may be left out", 1e-4,
        10.0);
    arguments.footer(
        "Simulates the scene 16 times with its Kirchhoff tensor and estimated loads. The bake ('samara bake "
        "SCENE')\n"
        "simulates again with the tables of each round of cases.\n");
    return run_program(argc, argv, arguments, [&] { return run(options, arguments); });
}
