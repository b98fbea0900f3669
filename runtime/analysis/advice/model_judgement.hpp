#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "samara/core/body/body.hpp"
#include "samara/motion/measures.hpp"

namespace samara {

/// Returns how far a simulated fall is from the solved one: the root mean square, over baked_metrics or,
/// where both autorotate, descent speed, spin rate and coning angle, of the natural logarithm of their ratio,
/// at most 1 each, and of 1 for another regime. A metric that only one of the falls has counts as 1.
double miss_of(const Measures& solved, const Measures& simulated);

/// One set of models beside the falls of a body.
struct JudgedModels {
    RecommendedModels models;
    std::vector<Measures> simulated = {};  ///< of each fall
    double miss = 0.0;                     ///< root mean square of miss_of() over the falls
};

/// Sets of models that a body can be simulated with, beside falls of it.
struct ModelJudgement {
    std::vector<Measures> solved;           ///< of each fall
    std::vector<JudgedModels> judged = {};  ///< the simplest first
    std::size_t best = 0;                   ///< index of the simplest that no other beats by a third
    /// Returns the best set; its origin says by how many falls, and its miss beside that of the next.
    [[nodiscard]] RecommendedModels recommended() const;
};

/// Judges the models that the body's data allow: loads by tables and by the surface, in one patch and in two.
/// `solved`: the metrics of the falls. `simulate` returns those of fall `i` by the models, without noise.
/// Throws Error where the body has neither tables nor surface loads.
ModelJudgement judge_models(
    const Body& body, std::vector<Measures> solved,
    const std::function<Measures(const RecommendedModels& models, std::size_t i)>& simulate);

/// Returns the models as words, such as "loads surface, 2 patches, turbulence none".
std::string in_words(const RecommendedModels& models);

/// Returns a judgement as lines of text: a table of the sets and their metrics, fall by fall.
std::string as_text(const ModelJudgement& judgement);

}  // namespace samara
