#include "samara/commands/shared/prepared_scene.hpp"

#include <utility>

#include "samara/commands/shared/scene_bodies.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/scene/terminal_speed.hpp"

namespace samara {
namespace {

std::vector<LoadedBody> loaded(Scene& scene, const Preparation& preparation) {
    std::unique_lock<std::recursive_mutex> lock;
    if (preparation.reading != nullptr) lock = std::unique_lock(*preparation.reading);
    return load_scene_bodies(scene, preparation.bodies);
}

std::optional<ModelAdvice> choose_models(PreparedScene& prepared, int threads,
                                         const AdviceProgress& progress) {
    Scene& scene = prepared.scene;
    bool any = false;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (!scene.bodies[i].models_auto) continue;
        (void)make_immersed_body(*prepared.bodies[i].body, scene.bodies[i], scene.fluid,
                                 scene.bodies[i].name);  // throws where tables lack
        any = true;
    }
    if (!any) return std::nullopt;
    AdviceOptions options;
    options.auto_alone = true;
    options.sampling.threads = threads;
    ModelAdvice advice = advise_models(scene, prepared.bodies, options, progress);
    apply(advice, scene);
    return advice;
}

std::optional<StepAdvice> choose_step(PreparedScene& prepared, int threads) {
    Scene& scene = prepared.scene;
    if (!scene.step_auto) return std::nullopt;
    const StepAdvice advice = advise_step(scene, prepared.bodies, threads);
    scene.step = advice.step;
    scene.step_auto = false;
    return advice;
}

}  // namespace

PreparedScene prepare_scene(Scene scene, const Preparation& preparation, const AdviceProgress& progress) {
    PreparedScene prepared{std::move(scene), {}, {}, {}};
    Scene& ready = prepared.scene;
    ready.seed = preparation.seed.value_or(ready.seed);
    if (preparation.step) {
        ready.step = *preparation.step;
        ready.step_auto = false;
    }
    prepared.bodies = loaded(ready, preparation);
    prepared.models = choose_models(prepared, preparation.threads, progress);
    prepared.step_advice = choose_step(prepared, preparation.threads);
    for (std::size_t i = 0; i < ready.bodies.size(); ++i) {
        require_sizes_in_tables(ready, ready.bodies[i], prepared.bodies[i]);
    }
    return prepared;
}

}  // namespace samara
