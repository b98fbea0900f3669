#include "samara/analysis/advice/model_judgement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "samara/analysis/metrics/metric_catalogue.hpp"
#include "samara/core/base/error.hpp"

namespace samara {
namespace {

// One fall more or less changes a miss by so much (docs/studies/spin, "The default").
constexpr double clearly_less = 2.0 / 3.0;
// Of falls that autorotate; what is left of an oscillation says little there.
constexpr std::array steady_spin_metrics = {Metric::descent_speed, Metric::spin_rate, Metric::coning_angle};

/// Returns the sets of models that the body's data allow, the simplest first.
std::vector<RecommendedModels> models_to_judge(const Body& body) {
    std::vector<RecommendedModels> sets;
    for (const int patches : {1, 2}) {
        if (body.tables) sets.push_back({.patches = patches});
        if (body.surface_loads) {
            sets.push_back({.loads = Loads::surface, .patches = patches});
        }
    }
    if (!sets.empty()) return sets;
    throw Error(
        fmt::format("body '{}' holds neither tables nor surface loads; add them with 'samara kirchhoff' "
                    "or 'samara bake'",
                    body.name));
}

std::string numbers_of(const Measures& fall) {
    return fmt::format("{:>9.4g} {:>9} {:>9.4g} {:>9.4g}  {}", fall.descent_speed,
                       fall.frequency ? fmt::format("{:.4g}", *fall.frequency) : "-",
                       fall.inclination_amplitude, fall.rms_angular_speed, name_of(fall.regime));
}

}  // namespace

double miss_of(const Measures& solved, const Measures& simulated) {
    const bool same_regime = simulated.regime == solved.regime;
    double sum = same_regime ? 0.0 : 1.0;
    int count = 1;
    const auto add = [&](Metric metric) {
        const double one = catalogued(metric).measured(solved).value_or(0.0);
        const double other = catalogued(metric).measured(simulated).value_or(0.0);
        if (one == 0.0 && other == 0.0) return;
        const double ratio = one == 0.0 ? 0.0 : other / one;
        const double miss = ratio > 0.0 ? std::min(1.0, std::abs(std::log(ratio))) : 1.0;
        sum += miss * miss;
        ++count;
    };
    if (same_regime && solved.autorotation && simulated.autorotation) {
        std::ranges::for_each(steady_spin_metrics, add);
    } else {
        std::ranges::for_each(baked_metrics, add);
    }
    return std::sqrt(sum / count);
}

RecommendedModels ModelJudgement::recommended() const {
    RecommendedModels models = judged[best].models;
    models.origin = fmt::format("judged by {} fall{}: off by {:.0f} %", solved.size(),
                                solved.size() == 1 ? "" : "s", 100.0 * judged[best].miss);
    const JudgedModels* next = nullptr;
    for (const JudgedModels& one : judged) {
        if (&one != &judged[best] && (next == nullptr || one.miss < next->miss)) next = &one;
    }
    if (next != nullptr) {
        models.origin += fmt::format(", next {}: {:.0f} %", in_words(next->models), 100.0 * next->miss);
    }
    return models;
}

ModelJudgement judge_models(const Body& body, std::vector<Measures> solved,
                            const std::function<Measures(const RecommendedModels&, std::size_t)>& simulate) {
    ModelJudgement judgement{.solved = std::move(solved)};
    for (const RecommendedModels& models : models_to_judge(body)) {
        JudgedModels one{.models = models};
        double sum = 0.0;
        for (std::size_t i = 0; i < judgement.solved.size(); ++i) {
            one.simulated.push_back(simulate(models, i));
            const double miss = miss_of(judgement.solved[i], one.simulated.back());
            sum += miss * miss;
        }
        one.miss = std::sqrt(sum / static_cast<double>(judgement.solved.size()));
        judgement.judged.push_back(std::move(one));
        const double least = judgement.judged[judgement.best].miss;
        if (judgement.judged.back().miss < clearly_less * least) judgement.best = judgement.judged.size() - 1;
    }
    return judgement;
}

std::string in_words(const RecommendedModels& models) {
    return fmt::format("loads {}, {} patch{}, turbulence {}", name_of(models.loads), models.patches,
                       models.patches == 1 ? "" : "es", name_of(models.turbulence));
}

std::string as_text(const ModelJudgement& judgement) {
    std::string text;
    for (std::size_t i = 0; i < judgement.solved.size(); ++i) {
        text +=
            fmt::format("fall {:<33} {:>9} {:>9} {:>9} {:>9}  regime\n", i + 1, "m/s", "Hz", "rad", "rad/s");
        text += fmt::format("  {:<36} {}\n", "solved", numbers_of(judgement.solved[i]));
        for (const JudgedModels& one : judgement.judged) {
            text += fmt::format("  {:<36} {}\n", in_words(one.models), numbers_of(one.simulated[i]));
        }
    }
    for (const JudgedModels& one : judgement.judged) {
        text += fmt::format("{:<38} off by {:.0f} %{}\n", in_words(one.models), 100.0 * one.miss,
                            &one == &judgement.judged[judgement.best] ? ", recommended" : "");
    }
    return text;
}

}  // namespace samara
