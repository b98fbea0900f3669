#include "samara/analysis/advice/model_advice.hpp"

#include <algorithm>
#include <cmath>
#include <list>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "samara/analysis/metrics/fall_metrics.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/dynamics/dynamic_coefficients.hpp"
#include "samara/core/physics/fluid.hpp"

namespace samara {
namespace {

constexpr int directions_of_mean = 1024;
constexpr double fewest_steps = 16.0;  // least steps of a fall that is judged

/// Returns points spread evenly over the sphere, by the golden angle.
Vector3d even_direction(int i, int count) {
    const double height = 1.0 - (2.0 * i + 1.0) / count;
    const double angle = 2.0 * std::numbers::pi * i * (std::numbers::phi - 1.0);
    const double radius = std::sqrt(1.0 - height * height);
    return {radius * std::cos(angle), radius * std::sin(angle), height};
}

/// Returns the one drag coefficient that has the tables' mean drag over all directions. Its area is the
/// projected one, whose mean is A: a quarter of the surface.
double mean_drag_coefficient(const LoadTables& tables, double reynolds_number) {
    double sum = 0.0;
    for (int i = 0; i < directions_of_mean; ++i) {
        const Vector3d direction = even_direction(i, directions_of_mean);
        sum -= look_up(tables, direction, reynolds_number).force.dot(direction);
    }
    return std::max(0.0, sum / directions_of_mean);
}

bool is_laminar(const LoadTables& tables) {
    return std::all_of(tables.entries.begin(), tables.entries.end(),
                       [](const LoadEntry& entry) { return entry.turbulent_kinetic_energy == 0.0; });
}

struct Reduction {
    ModelPart part;
    std::string left_out;
    ModelSet models;
};

/// Falls with one set of models, simulated batch by batch as they are asked for.
struct SimulatedSet {
    ModelSet models;
    std::vector<SampledFall> falls = {};
    FlowOnPath flow = {};                  ///< of the first batch
    double highest_reynolds_number = 0.0;  ///< of the first batch
    std::uint64_t batches = 0;
    bool is_finite = true;  ///< false where a fall leaves the range of numbers
};

/// The advice for one body.
class Advisor {
  public:
    Advisor(const Scene& scene, std::size_t index, const LoadedBody& loaded, const AdviceOptions& options,
            std::function<void()> count)
        : scene_(scene),
          index_(index),
          loaded_(loaded),
          options_(options),
          count_(std::move(count)),
          scene_body_(scene.bodies[index]) {}

    BodyAdvice advice() {
        advice_.name = scene_body_.name;
        advice_.duration = sampled_duration(scene_, scene_body_, options_.sampling);
        advice_.one_direction = loaded_.body->symmetry.type == Symmetry::Type::spherical;
        full_ = fullest();
        set_scale();
        advice_.full = unflown(full_, "");
        if (advice_.duration >= fewest_steps * scene_.step) {
            fly_fullest();
            advice_.full = effect(full_, "");
            time_step(advice_.full);
        }
        if (!is_long_enough()) {
            advice_.notes.emplace_back("the fall is too short to judge: all models are kept");
            advice_.recommended = advice_.full;
            return finished();
        }
        for (const Reduction& reduction : reductions(full_)) {
            advice_.omissions.push_back(effect(reduction.models, reduction.left_out));
            advice_.omissions.back().part = reduction.part;
            time_step(advice_.omissions.back());
        }
        advice_.recommended = effect(cheapest(), "");
        time_step(advice_.recommended);
        return finished();
    }

  private:
    /// Returns the models that the scene asks for, without those that lack data or have no effect.
    ModelSet fullest() {
        const ModelSet asked = model_set_of(scene_body_);
        const std::optional<LoadTables>& tables = loaded_.body->tables;
        if (uses_tables(asked) && !tables) {
            judges_all_ = false;
            const ModelSet guessed = model_set_of(guessed_before_bake(scene_, scene_body_, *loaded_.body));
            std::vector<std::string> unknown;
            if (asked.loads == Loads::table) unknown.emplace_back("table loads, simulated by coefficients");
            if (asked.turbulence == Turbulence::table) {
                unknown.push_back(fmt::format("turbulence, simulated {}",
                                              guessed.turbulence == Turbulence::none
                                                  ? "without"
                                                  : "with a tenth of the terminal speed (rms)"));
            }
            advice_.notes.push_back(fmt::format("unknown before a bake: {}", fmt::join(unknown, "; ")));
            return guessed;
        }
        ModelSet models = asked;
        if (models.turbulence == Turbulence::table && tables && is_laminar(*tables)) {
            advice_.notes.emplace_back(
                "no turbulence: the tables' turbulence is zero, as the flow is laminar");
            models.turbulence = Turbulence::none;
        }
        return models;
    }

    [[nodiscard]] Scene scene_with(const ModelSet& models) const {
        Scene scene = scene_;
        set_models(models, scene.bodies[index_]);
        return scene;
    }

    void fly_fullest() {
        const SimulatedSet& simulated = falls_of(full_, first_falls());
        if (!simulated.is_finite) {
            // Again, for its message.
            (void)sample_falls(scene_with(full_), index_, loaded_, options_.sampling);
        }
        const double highest = simulated.highest_reynolds_number;
        if (full_.turbulence == Turbulence::table && highest < laminar_reynolds_number) {
            advice_.notes.push_back(fmt::format(
                "no turbulence: the Reynolds number is {:.3g} at most, and the flow is laminar", highest));
            full_.turbulence = Turbulence::none;
            (void)falls_of(full_, first_falls());
        }
        advice_.flow = falls_of(full_, first_falls()).flow;
    }

    void set_scale() {
        scale_.tolerance = options_.tolerance;
        scale_.half_length = no_dynamic_coefficients(*loaded_.body).half_length;
        scale_.judges_inclination = tells(MetricSubject::inclination, *loaded_.body);
        scale_.judges_rotation = tells(MetricSubject::rotation, *loaded_.body);
    }

    bool is_long_enough() {
        if (sets_.empty()) return false;
        const SimulatedSet& simulated = falls_of(full_, first_falls());
        const auto measured = std::count_if(simulated.falls.begin(), simulated.falls.end(),
                                            [](const SampledFall& fall) { return fall.measured; });
        return 2 * static_cast<std::size_t>(measured) > simulated.falls.size();
    }

    [[nodiscard]] std::size_t first_falls() const {
        return static_cast<std::size_t>(options_.sampling.falls);
    }

    const SimulatedSet& falls_of(const ModelSet& models, std::size_t count) {
        auto found = std::find_if(sets_.begin(), sets_.end(),
                                  [&](const SimulatedSet& one) { return one.models == models; });
        if (found == sets_.end()) found = sets_.insert(sets_.end(), SimulatedSet{.models = models});
        while (found->is_finite && found->falls.size() < count) {
            try {
                const SampledFalls batch =
                    sample_falls(scene_with(models), index_, loaded_, options_.sampling, found->batches);
                found->falls.insert(found->falls.end(), batch.falls.begin(), batch.falls.end());
                if (found->batches == 0) {
                    found->flow = batch.flow;
                    found->highest_reynolds_number = batch.highest_reynolds_number;
                }
            } catch (const Error&) {
                found->is_finite = false;
            }
            ++found->batches;
            count_();
        }
        return *found;
    }

    void time_step(ModelEffect& one) const {
        if (!one.flies) return;
        try {
            one.nanoseconds_per_step =
                nanoseconds_per_step(scene_with(one.models), index_, loaded_, options_.sampling);
        } catch (const Error&) {
            one.nanoseconds_per_step = 0.0;  // the falls are longer here than in the scene
        }
    }

    /// Returns the description of a set, without its effects.
    [[nodiscard]] ModelEffect unflown(const ModelSet& models, const std::string& left_out) const {
        ModelEffect result;
        result.left_out = left_out;
        result.models = models;
        result.words = in_words(models, *loaded_.body);
        result.cost = cost_of(models, *loaded_.body);
        return result;
    }

    /// Returns the effects of a set, with as many falls as it takes to be certain.
    ModelEffect effect(const ModelSet& models, const std::string& left_out) {
        ModelEffect result = unflown(models, left_out);
        for (std::size_t falls = first_falls();; falls *= 2) {
            const SimulatedSet& other = falls_of(models, falls);
            result.flies = other.is_finite;
            if (!other.is_finite) {
                result.effect.verdict = EffectVerdict::beyond;
                return result;
            }
            result.effect = effect_of(falls_of(full_, falls).falls, other.falls, scale_);
            const bool more = 2 * falls <= static_cast<std::size_t>(options_.most_falls);
            if (result.effect.verdict != EffectVerdict::not_certain || !more) return result;
        }
    }

    /// Returns the sets with one part left out, dearest part first, and of each part the largest omission
    /// first.
    std::vector<Reduction> reductions(const ModelSet& from) {
        std::vector<Reduction> all;
        const auto add = [&](ModelPart part, const std::string& left_out, const auto& change) {
            ModelSet models = from;
            change(models);
            if (!uses_tables(models)) models.table_reynolds_number.reset();
            if (cost_of(models, *loaded_.body) < cost_of(from, *loaded_.body))
                all.push_back({part, left_out, models});
        };
        const FlowOnPath& flow = advice_.flow;
        if (judges_all_) {
            if (cost_of(from, *loaded_.body).falls) {
                add(ModelPart::identified_coefficients, "identified coefficients (default)",
                    [](ModelSet& models) { models.dynamic = Dynamic::by_default; });
            }
            if (from.loads == Loads::table) {
                const double drag = mean_drag_coefficient(*loaded_.body->tables, flow.reynolds_number);
                add(ModelPart::table_loads, fmt::format("table loads (drag coefficient {:.3g})", drag),
                    [&](ModelSet& models) {
                        models.loads = Loads::coefficients;
                        models.drag_coefficient = drag;
                    });
            }
            add(ModelPart::turbulence, "turbulence",
                [](ModelSet& models) { models.turbulence = Turbulence::none; });
            // On the ground constant turbulence would go on shaking a body that lies still.
            if (from.turbulence == Turbulence::table && flow.turbulent_kinetic_energy > 0.0 &&
                !scene_.ground) {
                add(ModelPart::turbulence, "turbulence by direction (constant)", [&](ModelSet& models) {
                    models.turbulence = Turbulence::constant;
                    models.turbulent_kinetic_energy = flow.turbulent_kinetic_energy;
                    models.dissipation_rate = flow.dissipation_rate;
                });
            }
            if (flow.reynolds_number > 0.0) {
                add(ModelPart::reynolds_dependence, "further Reynolds numbers",
                    [&](ModelSet& models) { models.table_reynolds_number = flow.reynolds_number; });
            }
        }
        add(ModelPart::added_mass, "added mass", [](ModelSet& models) { models.added_mass = false; });
        if (judges_all_ && from.loads != Loads::none) {
            add(ModelPart::dynamic_coefficients, "all dynamic coefficients",
                [](ModelSet& models) { models.dynamic = Dynamic::none; });
        }
        return all;
    }

    /// Returns whether this omission alone changes the falls of the fullest set: beside another omission
    /// whose error cancels its own it may seem not to.
    [[nodiscard]] bool matters(const std::string& left_out) const {
        return std::ranges::any_of(advice_.omissions, [&](const ModelEffect& one) {
            return one.left_out == left_out && one.effect.verdict == EffectVerdict::beyond;
        });
    }

    /// Leaves out the dearest part that can go, and so on with the rest, until none can. A part that matters
    /// alone stays.
    ModelSet cheapest() {
        ModelSet now = full_;
        for (bool found = true; found;) {
            found = false;
            for (const Reduction& reduction : reductions(now)) {
                if (matters(reduction.left_out)) continue;
                if (effect(reduction.models, "").effect.verdict != EffectVerdict::within) continue;
                now = reduction.models;
                found = true;
                break;
            }
        }
        return now;
    }

    BodyAdvice finished() {
        if (!judges_all_) {
            // It differs from the scene's models only for want of tables.
            ModelSet models = model_set_of(scene_body_);
            models.added_mass = advice_.recommended.models.added_mass;
            advice_.recommended.models = models;
            advice_.recommended.words = in_words(models, *loaded_.body);
            advice_.recommended.cost = cost_of(models, *loaded_.body);
        }
        return std::move(advice_);
    }

    const Scene& scene_;
    std::size_t index_;
    const LoadedBody& loaded_;
    const AdviceOptions& options_;
    std::function<void()> count_;
    const SceneBody& scene_body_;
    ModelSet full_;
    EffectScale scale_;
    bool judges_all_ = true;
    std::list<SimulatedSet> sets_;
    BodyAdvice advice_;
};

}  // namespace

ModelAdvice advise_models(const Scene& scene, const std::vector<LoadedBody>& loaded,
                          const AdviceOptions& options, const AdviceProgress& progress) {
    constexpr double usual_falls = 24.0;  // batches of one body
    ModelAdvice advice;
    advice.tolerance = options.tolerance;
    std::vector<std::size_t> judged;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        if (!options.auto_alone || scene.bodies[i].models_auto) judged.push_back(i);
    }
    const double total = usual_falls * static_cast<double>(judged.size());
    for (std::size_t i = 0; i < judged.size(); ++i) {
        double done = 0.0;
        const double before = usual_falls * static_cast<double>(i);
        const auto count = [&] { progress(before + std::min(++done, usual_falls - 1.0), total); };
        advice.bodies.push_back(Advisor(scene, judged[i], loaded[judged[i]], options, count).advice());
        progress(before + usual_falls, total);
    }
    return advice;
}

void apply(const ModelAdvice& advice, Scene& scene) {
    for (const BodyAdvice& body : advice.bodies) {
        const auto found = std::find_if(scene.bodies.begin(), scene.bodies.end(),
                                        [&](const SceneBody& one) { return one.name == body.name; });
        if (found != scene.bodies.end()) set_models(body.recommended.models, *found);
    }
}

}  // namespace samara
