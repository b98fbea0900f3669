#include "internal/command/scene_bodies.hpp"

#include <filesystem>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "internal/base/content_hash.hpp"
#include "internal/base/labelled.hpp"
#include "internal/command/load_body.hpp"
#include "internal/dynamics/immersed_body.hpp"
#include "internal/files/input_file.hpp"
#include "samara/base/error.hpp"
#include "samara/body/body_file.hpp"
#include "samara/kirchhoff/kirchhoff_solver.hpp"
#include "samara/kirchhoff/surface_flow.hpp"

namespace samara {
namespace {

/// The file a body of the scene flies with: the baked one where a folder of them is given.
std::filesystem::path file_of(const SceneBody& scene_body, const std::string& bodies) {
    if (bodies.empty()) return scene_body.shape;
    const auto baked = std::filesystem::path(bodies) / (scene_body.name + ".body.h5");
    if (const std::string fault = reading_fault(baked); !fault.empty()) {
        throw Error(
            fmt::format("{}: {}; bake it with 'samara bake SCENE -o {}'", baked.string(), fault, bodies));
    }
    return baked;
}

/// Refuses a body that was baked before its shape was changed.
void require_same_shape(const std::filesystem::path& file, const Body& body, const SceneBody& scene_body) {
    if (is_body_file_name(scene_body.shape)) return;
    if (body.source.find(file_content_hash(scene_body.shape)) != std::string::npos) return;
    throw Error(fmt::format("{}: was made from another shape than {} is now; bake the scene again",
                            file.string(), scene_body.shape.string()));
}

/// The bodies of a scene: what several have in common is read, meshed and solved once.
class LoadedBodies {
  public:
    explicit LoadedBodies(std::string folder) : folder_(std::move(folder)) {}

    LoadedBody operator()(const SceneBody& scene_body) {
        const std::filesystem::path file = file_of(scene_body, folder_);
        // A baked body is in metres already: the scene's scale went into it.
        const double scale = folder_.empty() ? scene_body.scale : 1.0;
        const bool asked = scene_body.loads == Loads::surface;
        const bool surface_loads = asked || scene_body.loads_by_default;
        const auto [place, is_new] = known_.try_emplace({file, scale, scene_body.added_mass, surface_loads});
        if (is_new) place->second = load(file, scale, scene_body.added_mass, surface_loads);
        if (!folder_.empty()) require_same_shape(file, *place->second->body, scene_body);
        return *place->second;
    }

  private:
    static LoadedBody load(const std::filesystem::path& file, double scale, bool added_mass,
                           bool surface_loads) {
        Body body = load_body(file, scale);
        if (added_mass && !body.kirchhoff) {
            body.kirchhoff =
                labelled(file.string(), [&] { return kirchhoff_tensor(body); });
        }
        if (surface_loads && !body.surface_loads) {
            body.surface_loads =
                labelled(file.string(), [&] { return samara::surface_loads(body.surface, body.moments); });
        }
        return {std::move(body), file_content_hash(file)};
    }

    std::string folder_;
    std::map<std::tuple<std::filesystem::path, double, bool, bool>, std::optional<LoadedBody>> known_;
};

/// Whether a body that the scene leaves to what its file holds is without the tables for it.
bool flies_by_surface(const SceneBody& scene_body, const Body& body) {
    if (body.tables || !scene_body.loads_by_default || scene_body.models_auto) return false;
    const bool asks_for_tables =
        scene_body.table_reynolds_number ||
        (!scene_body.turbulence_by_default && scene_body.turbulence == Turbulence::table);
    return !asks_for_tables;
}

}  // namespace

std::vector<LoadedBody> load_scene_bodies(Scene& scene, const std::string& folder) {
    std::vector<LoadedBody> loaded;
    LoadedBodies load(folder);
    for (SceneBody& body : scene.bodies) {
        loaded.push_back(load(body));
        if (flies_by_surface(body, *loaded.back().body)) {
            body.loads = Loads::surface;
            if (body.turbulence_by_default) body.turbulence = Turbulence::none;
        }
    }
    return loaded;
}

std::optional<ModelAdvice> choose_models(Scene& scene, const std::vector<LoadedBody>& loaded, int threads,
                                         const AdviceProgress& progress) {
    bool any = false;
    for (std::size_t i = 0; i < loaded.size(); ++i) {
        if (!scene.bodies[i].models_auto) continue;
        (void)make_immersed_body(*loaded[i].body, scene.bodies[i], scene.fluid,
                                 scene.bodies[i].name);  // throws where tables lack
        any = true;
    }
    if (!any) return std::nullopt;
    AdviceOptions options;
    options.auto_alone = true;
    options.sampling.threads = threads;
    ModelAdvice advice = advise_models(scene, loaded, options, progress);
    apply(advice, scene);
    return advice;
}

std::optional<StepAdvice> choose_step(Scene& scene, const std::vector<LoadedBody>& loaded, int threads) {
    if (!scene.step_auto) return std::nullopt;
    const StepAdvice advice = advise_step(scene, loaded, threads);
    scene.step = advice.step;
    scene.step_auto = false;
    return advice;
}

}  // namespace samara
