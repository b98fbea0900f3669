#pragma once

#include <optional>
#include <string>
#include <vector>

#include "samara/analysis/advice/model_advice.hpp"
#include "samara/analysis/advice/step_advice.hpp"
#include "samara/core/simulation/loaded_body.hpp"
#include "samara/scene/scene.hpp"

namespace samara {

/// The bodies of a scene, in its order, each with the added mass that the scene asks for: what several have
/// in common is read, meshed and solved once. `folder`: of baked bodies, NAME.body.h5 for each body of the
/// scene; empty: the scene's own shapes. Bodies whose loads the scene leaves to their files are made to fly
/// by those of their surface, in still fluid, where these hold no tables. Throws Error where one cannot be
/// had, or was baked from another shape.
std::vector<LoadedBody> load_scene_bodies(Scene& scene, const std::string& folder);

/// Chooses the models of the bodies that leave them to the advice, and says which; nothing where none does.
/// `threads`: 0 for all cores. Throws Error where a body lacks the tables for it.
std::optional<ModelAdvice> choose_models(Scene& scene, const std::vector<LoadedBody>& loaded, int threads,
                                         const AdviceProgress& progress);

/// Sets the step of a scene that leaves it to the advice, once its models are chosen; nothing where it does
/// not. `threads`: 0 for all cores.
std::optional<StepAdvice> choose_step(Scene& scene, const std::vector<LoadedBody>& loaded, int threads);

}  // namespace samara
