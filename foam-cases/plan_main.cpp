// The program samara-plan: plans the bake of a scene.

#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "foam-cases/bake/bake.hpp"
#include "foam-cases/bake/bake_report.hpp"
#include "foam-cases/scene/scene_plan_report.hpp"
#include "samara/analysis/advice/input_warnings.hpp"
#include "samara/analysis/advice/model_advice.hpp"
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
    const Scene scene = read_scene_file(options.scene);
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
    nlohmann::json result = {{"bodies", nlohmann::json::array()}};
    nlohmann::json picture;
    std::vector<LoadedBody> loaded;
    BodyNotes notes("samara plan");
    for (const BakeRequest& request : requests_for_scene(scene, folder, wanted)) {
        const BakePreparation preparation = prepare_bake(request);
        note_warnings(notes, request, preparation);
        result["bodies"].push_back(plan_body(request, preparation, options, arguments.json(), picture));
        loaded.push_back(as_baked(request, preparation, !options.bodies.empty()));
        const SceneBody& body = scene.bodies[loaded.size() - 1];
        const DensityWarning density = density_warning(body, *loaded.back().body, scene.fluid);
        notes.add("density", body.name, density.ratio, density.text);
    }
    notes.print();
    const ModelAdvice advice = advised(scene, loaded, options.tolerance);
    if (!arguments.json()) print_result("{}", as_text(advice));
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
