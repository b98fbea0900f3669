#pragma once

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "samara/analysis/advice/model_advice.hpp"
#include "samara/analysis/advice/step_advice.hpp"
#include "samara/core/simulation/loaded_body.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// How a scene is made ready, and what is asked of it instead of what it says.
struct Preparation {
    std::string bodies = {};                  ///< folder of baked bodies; empty: the scene's own shapes
    std::optional<std::uint64_t> seed = {};   ///< instead of the scene's
    std::optional<double> step = {};          ///< s: instead of the scene's, also where it is "auto"
    int threads = 0;                          ///< 0: all cores; what is chosen is the same for any number
    std::recursive_mutex* reading = nullptr;  ///< held while files are read, where it is given
};

/// A scene with all that its simulation needs, for SceneSimulation and simulation_of().
struct PreparedScene {
    Scene scene;                            ///< its models and its step are chosen
    std::vector<LoadedBody> bodies;         ///< `bodies[i]` is the body of scene.bodies[i]
    std::optional<ModelAdvice> models;      ///< nothing where no body leaves its models to the advice
    std::optional<StepAdvice> step_advice;  ///< nothing where the scene, or who flies it, gives the step
};

/// Makes a scene ready to fly: loads its bodies (load_scene_bodies), chooses the models of those that leave
/// them to the advice (models = "auto"), and then the step where it is left to it (step = "auto"). Every
/// simulation of a scene is prepared here, so that the same scene gives the same motion in every program.
/// `progress`: of judging models. Throws Error where a body cannot be had, lacks tables that its models ask
/// for, or has copies of sizes that are beyond its tables.
PreparedScene prepare_scene(
    Scene scene, const Preparation& preparation, const AdviceProgress& progress = [](double, double) {});

}  // namespace samara
