#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "samara/analysis/advice/model_effect.hpp"
#include "samara/analysis/advice/model_set.hpp"
#include "samara/analysis/metrics/sampled_falls.hpp"
#include "samara/scene/scene_simulation.hpp"

namespace samara {

/// Options of advise_models().
struct AdviceOptions {
    double tolerance = 0.05;  ///< relative, of the
                              ///< descent speed; the other metrics' follow in proportion (EffectScale)
    int most_falls = 256;     ///< most falls with one set of models, where fewer leave a verdict uncertain
    bool auto_alone = false;  ///< whether only the bodies with models = "auto" are judged
    FallSampling sampling;
};

/// The effects of a set of models beside the fullest.
struct ModelEffect {
    std::string left_out;  ///< text, such as "added mass"; empty for the recommended set
    std::optional<ModelPart> part;
    ModelSet models;
    std::string words;  ///< in_words() of the models
    ModelCost cost;
    FallsEffect effect;
    bool flies = true;  ///< false where a simulation with these models leaves the range of numbers
    double nanoseconds_per_step = 0.0;  ///< nanoseconds_per_step(): for information alone
};

/// The models that a body of a scene needs.
struct BodyAdvice {
    std::string name;
    ModelEffect full;                    ///< the fullest model; its effect is none
    std::vector<ModelEffect> omissions;  ///< sets with one part left out, dearest first
    ModelEffect recommended;             ///< the cheapest set found, simulated and checked as a whole
    FlowOnPath flow;                     ///< mean flow around the fullest model
    double duration = 0.0;               ///< s, of each fall
    std::vector<std::string> notes;  ///< parts that were not judged or needed no simulation, a sentence each
    bool one_direction = false;      ///< whether tables need one direction: the shape is a sphere's
};

/// The models that the bodies of a scene need.
struct ModelAdvice {
    double tolerance = 0.05;
    std::vector<BodyAdvice> bodies;
};

/// Is called with the simulations done and in total; the total is an estimate at first.
using AdviceProgress = std::function<void(double done, double total)>;

/// Simulates each body of the scene with the fullest model (that of the scene: its defaults are everything
/// that the body file has) and with less, and finds the cheapest set whose metrics all stay within the
/// tolerance, by two standard errors: the dearest part (ModelPart, ModelCost) that can be left out goes
/// first, then the next on what is left, until none can. What is not certain is kept. `loaded[i]` is the body
/// of scene.bodies[i]. A body without tables is simulated as guessed_before_bake(), and only its added mass
/// is judged. The result does not depend on the number of threads, apart from the nanoseconds. Throws Error
/// where a body cannot be simulated at all.
ModelAdvice advise_models(const Scene& scene, const std::vector<LoadedBody>& loaded,
                          const AdviceOptions& options, const AdviceProgress& progress);

/// Gives the bodies of the scene, by their names, the recommended models.
void apply(const ModelAdvice& advice, Scene& scene);

/// Returns the advice as text: for each body a table of the effects of each part, and the recommended set;
/// every line ended.
std::string as_text(const ModelAdvice& advice);

/// Returns the advice as a JSON object in SI units and radians: docs/explanation/what-a-scene-needs.md lists
/// its keys.
nlohmann::json as_json(const ModelAdvice& advice);

}  // namespace samara
