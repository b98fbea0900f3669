#pragma once

#include <optional>
#include <vector>

#include "samara/analysis/metrics/sampled_falls.hpp"

namespace samara {

/// Whether the effect of a change of models is within its tolerance, by two standard errors either way.
enum class EffectVerdict { within, not_certain, beyond };
/// Returns "within", "not certain" or "beyond".
const char* name_of(EffectVerdict verdict);

/// The effect of a change of models on one metric of the falls.
struct MetricEffect {
    std::optional<Estimate> reference;  ///< value with the fullest model
    std::optional<Estimate> value;      ///< value with the other model
    std::optional<Estimate> change;     ///< value - reference, its error from pairs of falls
    double scale = 0.0;           ///< scale of the change: the reference, or one that follows from the path
    std::optional<double> limit;  ///< largest change allowed; nothing where the metric is not judged
    EffectVerdict verdict = EffectVerdict::within;
};

/// The effects of a change of models on a body's falls.
struct FallsEffect {
    PerMetric<MetricEffect> metrics;           ///< those of advised_metrics
    Regime reference_regime = Regime::steady;  ///< the commonest
    Regime regime = Regime::steady;
    double regime_share = 0.0;  ///< share, among the other's falls, of the fullest model's commonest regime
    bool regimes_agree = true;  ///< whether the commonest regimes are one, or differ by chance
    std::size_t falls = 0;      ///< pairs that it rests on
    EffectVerdict verdict = EffectVerdict::within;  ///< the worst
                                                    ///< verdict of metrics and regime
};

/// The metrics that are judged of a body, and their scales.
struct EffectScale {
    double tolerance = 0.05;         ///< t, of the descent speed; the others' in the catalogue's proportions
    double half_length = 0.0;        ///< m: a tip speed below t times the mean speed is ignored
    bool judges_inclination = true;  ///< false for bodies without a shortest axis
    bool judges_rotation = true;     ///< false for bodies whose look does not depend on their orientation
};

/// Compares falls with another model with those with the fullest, fall i with fall i, which have one draw of
/// noise and start. Standard errors by the jackknife over the pairs, since the pairs share what chance they
/// can.
///
/// Limits are the catalogue's share times the tolerance t times the scale: the descent speed's is the mean
/// speed through the fluid, the others' are the metrics themselves, and at least: for the amplitude the value
/// that makes the limit a degree; for the rms angular speed the value that moves the tip at t of the mean
/// speed; for the path's spread a third of the distance from the release. The frequency is judged where
/// either falls other than steadily, and beyond where most falls of one have a frequency and most of the
/// other have none. Regimes differ where the commonest are different and the share of the fullest model's
/// differs by more than two standard errors.
FallsEffect effect_of(const std::vector<SampledFall>& reference, const std::vector<SampledFall>& falls,
                      const EffectScale& scale);

}  // namespace samara
