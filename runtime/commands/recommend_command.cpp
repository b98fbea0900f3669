// samara recommend: the models that a body is simulated with where a scene does not say.

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "samara/analysis/advice/model_judgement.hpp"
#include "samara/commands/body_report.hpp"
#include "samara/commands/commands.hpp"
#include "samara/commands/option_values.hpp"
#include "samara/commands/shared/arguments.hpp"
#include "samara/commands/shared/print.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/surface/surface_patches.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/scene/scene_file.hpp"
#include "samara/scene/scene_simulation.hpp"

namespace samara {
namespace {

struct Request {
    std::string file;
    std::string output;
    std::string falls;
    std::string loads;
    std::optional<int> patches;
    std::string turbulence;
};

/// A fall to judge by: the scene that describes it, with the body alone, and its metrics.
struct JudgedFall {
    Scene scene;
    Measures solved;
};

JudgedFall judged_fall(const std::string& scene_file, const std::string& reference_file) {
    const Motion reference = read_motion_file(reference_file);
    const BodyMotion& solved = find_body(reference_file, reference, "");
    JudgedFall fall{read_scene_file(scene_file), measure(reference, solved)};
    std::vector<SceneBody>& bodies = fall.scene.bodies;
    if (bodies.size() > 1)
        std::erase_if(bodies, [&](const SceneBody& body) { return body.name != solved.name; });
    if (bodies.size() != 1) {
        throw Error(fmt::format("{}: has no body '{}', the one that {} holds; give the scene of this fall",
                                scene_file, solved.name, reference_file));
    }
    bodies.front().count = 1;
    fall.scene.duration = reference.times.back();
    fall.scene.frame_rate = reference.frame_rate;
    return fall;
}

std::vector<JudgedFall> judged_falls(const std::string& list) {
    const std::vector<std::string> files = comma_separated(list);
    if (files.empty() || files.size() % 2 != 0) {
        throw Error(
            "--falls takes pairs of a scene and its reference motion, separated by commas, such as "
            "fall.toml,fall.h5");
    }
    std::vector<JudgedFall> falls;
    for (std::size_t i = 0; i < files.size(); i += 2) falls.push_back(judged_fall(files[i], files[i + 1]));
    return falls;
}

Measures simulated(Scene scene, const Body& body, const RecommendedModels& models) {
    SceneBody& one = scene.bodies.front();
    one.loads = models.loads;
    one.patches = models.patches;
    one.turbulence = Turbulence::none;
    const Motion motion = simulate(
                              scene, {LoadedBody(body, "")}, 1, [](double, double) { return true; }, 1)
                              .motion;
    return measure(motion, motion.bodies.front());
}

RecommendedModels judged(const Request& request, const Body& body, bool quiet) {
    const std::vector<JudgedFall> falls = judged_falls(request.falls);
    std::vector<Measures> solved;
    solved.reserve(falls.size());
    for (const JudgedFall& fall : falls) solved.push_back(fall.solved);
    const ModelJudgement judgement =
        judge_models(body, solved, [&](const RecommendedModels& models, std::size_t i) {
            return simulated(falls[i].scene, body, models);
        });
    if (!quiet) print_result("{}", as_text(judgement));
    return judgement.recommended();
}

RecommendedModels given(const Request& request) {
    RecommendedModels models;
    models.loads = request.loads == "surface" ? Loads::surface : Loads::table;
    models.patches = request.patches.value_or(1);
    models.turbulence = request.turbulence == "none" ? Turbulence::none : Turbulence::table;
    models.origin = "given";
    return models;
}

nlohmann::json run(const Request& request, bool json) {
    if (request.falls.empty() == request.loads.empty()) {
        throw Error("give either --loads or --falls, by which the models are judged");
    }
    if (!request.falls.empty() && (request.patches || !request.turbulence.empty())) {
        throw Error("--falls judges the models itself; leave out --patches and --turbulence");
    }
    const std::string output = request.output.empty() ? request.file : request.output;
    if (!is_body_file_name(output)) {
        throw Error(fmt::format("{}: the name of a body file must end in .body.h5", output));
    }
    Body body = read_body_file(request.file);
    body.recommended = request.falls.empty() ? given(request) : judged(request, body, json);
    if (const std::string error = error_of(*body.recommended); !error.empty()) {
        throw Error(fmt::format("{}: {}; choose other models", request.file, error));
    }
    write_body_file(output, body);
    if (!json) print_recommended(body);
    nlohmann::json result = body_as_json(body)["recommended"];
    result["output"] = output;
    return result;
}

}  // namespace

int recommend_command(int argc, const char* const* argv) {
    Request request;
    Arguments arguments("samara recommend",
                        "Sets the default models in a body file, for scenes that do not choose them.");
    arguments.positional("FILE", request.file, "body file (.body.h5)");
    arguments.output_option("-o,--output", request.output, "body file to write; by default FILE itself");
    arguments.option("--falls", request.falls,
                     "SCENE,REFERENCE: judges the models by a fall, such as one by full CFD; more pairs "
                     "follow after a comma");
    arguments.choice("--loads", request.loads, {"table", "surface"}, "sets the loads, without a judgement");
    arguments.option("--patches", request.patches, "with --loads: patches of the surface; by default 1", 1,
                     most_surface_patches);
    arguments.choice("--turbulence", request.turbulence, {"table", "none"},
                     "with --loads: the noise; by default that of the table, where the loads are");
    arguments.footer(
        "Models in a scene take precedence. 'samara bake' and 'samara identify' judge the models by the "
        "falls "
        "that they solve.\n"
        "JSON: loads, patches, turbulence, origin, output.\n\n"
        "Example: samara recommend seed.body.h5 --falls seed.toml,reference.h5");
    return run_program(argc, argv, arguments, [&] { return run(request, arguments.json()); });
}

}  // namespace samara
