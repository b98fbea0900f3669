#include "samara/analysis/advice/model_effect.hpp"

#include <algorithm>
#include <cmath>

namespace samara {
namespace {

constexpr std::size_t fewest_pairs = 8;

using Falls = std::vector<const SampledFall*>;

/// Returns the mean of a metric over all falls but one.
std::optional<Estimate> metric_without(const Falls& falls, Metric metric, std::size_t left_out) {
    std::vector<Estimate> values;
    for (std::size_t i = 0; i < falls.size(); ++i) {
        const auto& value = falls[i]->metrics[metric];
        if (i != left_out && value) values.push_back({*value, {}, {}});
    }
    return mean_of(values, catalogued(metric).mean);
}

bool most_have(const Falls& falls, Metric metric) {
    return 2 * std::ranges::count_if(
                   falls, [&](const SampledFall* fall) { return fall->metrics[metric].has_value(); }) >=
           std::ssize(falls);
}

std::optional<Estimate> change_of(const Falls& reference, const Falls& falls, Metric metric) {
    const std::size_t none = falls.size();
    const auto before = metric_without(reference, metric, none);
    const auto after = metric_without(falls, metric, none);
    if (!before || !after) return std::nullopt;
    Estimate change{after->value - before->value, {}, {}};
    std::vector<double> values;
    for (std::size_t i = 0; i < falls.size(); ++i) {
        const auto one = metric_without(reference, metric, i);
        const auto other = metric_without(falls, metric, i);
        if (!one || !other) return change;
        values.push_back(other->value - one->value);
    }
    if (values.size() >= fewest_pairs) change.error = jackknife_error(values, values.size(), 1);
    return change;
}

EffectVerdict verdict_of(const Estimate& change, double limit) {
    if (!change.error) return EffectVerdict::not_certain;
    const double distance = std::abs(change.value);
    const double warning = certain_errors * *change.error;
    if (distance + warning <= limit) return EffectVerdict::within;
    return distance - warning > limit ? EffectVerdict::beyond : EffectVerdict::not_certain;
}

RegimeCounts regimes_of(const Falls& falls) {
    RegimeCounts regimes;
    for (const SampledFall* fall : falls) regimes.add(fall->regime);
    return regimes;
}

/// Returns whether the shares in two samples of one size differ by more than chance.
bool shares_agree(double a, double b, std::size_t count) {
    const double middle = 0.5 * (a + b);
    const double error = std::sqrt(2.0 * middle * (1.0 - middle) / static_cast<double>(count));
    return std::abs(a - b) <= certain_errors * error;
}

double mean_over(const Falls& falls, double SampledFall::*member) {
    double sum = 0.0;
    for (const SampledFall* fall : falls) sum += fall->*member;
    return sum / static_cast<double>(falls.size());
}

/// Returns whether a metric is defined for these falls.
bool is_judged(Metric metric, const EffectScale& scale, bool swings) {
    if (metric == Metric::frequency && !swings) return false;
    switch (catalogued(metric).subject) {
        case MetricSubject::inclination:
            return scale.judges_inclination;
        case MetricSubject::rotation:
            return scale.judges_rotation;
        default:
            return true;
    }
}

double scale_of(Metric metric, double reference, const Falls& falls, const EffectScale& scale) {
    const double speed = mean_over(falls, &SampledFall::speed);
    const AllowedError& allowed = catalogued(metric).allowed;
    switch (metric) {
        case Metric::descent_speed:
            return std::max(reference, speed);
        case Metric::inclination_amplitude:
            return std::max(reference, allowed.always / (allowed.share * scale.tolerance));
        case Metric::rms_angular_speed:
            return std::max(reference, speed / (allowed.share * scale.half_length));
        case Metric::path_spread:
            return std::max(reference, mean_over(falls, &SampledFall::distance) / allowed.share);
        default:
            return reference;
    }
}

}  // namespace

const char* name_of(EffectVerdict verdict) {
    constexpr const char* names[] = {"within", "not certain", "beyond"};
    return names[static_cast<int>(verdict)];
}

FallsEffect effect_of(const std::vector<SampledFall>& reference, const std::vector<SampledFall>& falls,
                      const EffectScale& scale) {
    Falls before;
    Falls after;
    for (std::size_t i = 0; i < std::min(reference.size(), falls.size()); ++i) {
        if (!reference[i].measured || !falls[i].measured) continue;
        before.push_back(&reference[i]);
        after.push_back(&falls[i]);
    }
    FallsEffect effect;
    effect.falls = after.size();
    if (after.empty()) {
        effect.verdict = EffectVerdict::not_certain;
        return effect;
    }
    const RegimeCounts regimes_before = regimes_of(before);
    const RegimeCounts regimes_after = regimes_of(after);
    effect.reference_regime = regimes_before.commonest();
    effect.regime = regimes_after.commonest();
    effect.regime_share = regimes_after.share(effect.reference_regime);
    effect.regimes_agree =
        effect.regime == effect.reference_regime ||
        shares_agree(regimes_before.share(effect.reference_regime), effect.regime_share, after.size());
    const bool swings = effect.regime != Regime::steady || effect.reference_regime != Regime::steady;
    if (scale.judges_inclination && !effect.regimes_agree) effect.verdict = EffectVerdict::beyond;

    for (const Metric which : advised_metrics) {
        MetricEffect& metric = effect.metrics[which];
        metric.reference = metric_without(before, which, before.size());
        metric.value = metric_without(after, which, after.size());
        metric.change = change_of(before, after, which);
        metric.scale =
            scale_of(which, metric.reference ? std::abs(metric.reference->value) : 0.0, before, scale);
        const bool had = most_have(before, which);
        const bool has = most_have(after, which);
        if (!is_judged(which, scale, swings) || (!had && !has)) continue;
        metric.limit = catalogued(which).allowed.share * scale.tolerance * metric.scale;
        metric.verdict = had && has ? verdict_of(*metric.change, *metric.limit) : EffectVerdict::beyond;
        effect.verdict = std::max(effect.verdict, metric.verdict);
    }
    return effect;
}

}  // namespace samara
