#pragma once

#include <optional>
#include <vector>

#include "samara/analysis/metrics/sampled_falls.hpp"

namespace samara {

/// Whether what a change of models does stays within its tolerance, two standard errors either way.
enum class EffectVerdict { within, not_certain, beyond };
/// "within", "not certain", "beyond".
const char* name_of(EffectVerdict verdict);

/// What a change of models does to one figure of the falls.
struct MetricEffect {
    std::optional<Estimate> reference;  ///< of the fullest model
    std::optional<Estimate> value;      ///< of the other
    std::optional<Estimate> change;     ///< value - reference, its error from pairs of falls
    double scale = 0.0;  ///< what the change is small against: the reference, or what the way makes of it
    std::optional<double> limit;  ///< of the change; nothing where the figure is not judged
    EffectVerdict verdict = EffectVerdict::within;
};

/// What a change of models does to a body's falls.
struct FallsEffect {
    PerMetric<MetricEffect> metrics;           ///< of advised_metrics
    Regime reference_regime = Regime::steady;  ///< the commonest
    Regime regime = Regime::steady;
    double regime_share = 0.0;  ///< of the commonest regime of the fullest model, among the other's falls
    bool regimes_agree = true;  ///< the commonest are the same, or chance makes as much of a difference
    std::size_t falls = 0;      ///< pairs that it rests on
    EffectVerdict verdict = EffectVerdict::within;  ///< the worst of all that is judged
};

/// What is judged of a body, and in which proportion.
struct EffectScale {
    double tolerance = 0.05;         ///< t, of the descent speed; the others' in the catalogue's proportions
    double half_length = 0.0;        ///< m: a tip speed below t of the way's speed is not noticed
    bool judges_inclination = true;  ///< false for bodies without a shortest axis
    bool judges_rotation = true;     ///< false for bodies that look the same however they are turned
};

/// Holds falls of another model against those of the fullest, fall i against fall i: the same draw of noise
/// and start. Standard errors by the jackknife over the pairs, since the pairs share what chance they can.
///
/// Limits are the catalogue's share times the tolerance t times the scale: the descent speed's is the mean
/// speed through the fluid, the others' are the figures themselves, and at least: of the amplitude what makes
/// the limit a degree; of the rms angular speed what moves the tip at t of the mean speed; of the path's
/// spread a third of the distance from the release. The frequency is judged where either falls other than
/// steadily, and beyond where most falls of one have a frequency and most of the other have none. Regimes
/// differ where the commonest are different and the share of the fullest model's differs by more than two
/// standard errors.
FallsEffect effect_of(const std::vector<SampledFall>& reference, const std::vector<SampledFall>& falls,
                      const EffectScale& scale);

}  // namespace samara
