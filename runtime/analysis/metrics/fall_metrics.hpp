#pragma once

#include <array>

#include "samara/analysis/metrics/fall_series.hpp"
#include "samara/analysis/metrics/metric_catalogue.hpp"
#include "samara/analysis/metrics/spectrum.hpp"
#include "samara/core/body/body.hpp"

namespace samara {

/// The percentages of the quantiles by which distributions of the inclination are compared.
inline constexpr std::array<double, 5> quantile_percents = {5.0, 25.0, 50.0, 75.0, 95.0};

/// The quantities whose distributions over time are compared where falls are irregular: the inclination; the
/// angular speed; and the mode of each piece of a fall, which is still, swings or turns over.
enum class Distribution { inclination, angular_speed, mode };
/// One value for each of them.
template <typename Value>
using PerDistribution = std::array<Value, 3>;
/// Their names in JSON, and as text.
inline constexpr PerDistribution<const char*> distribution_keys = {"inclination", "angular_speed", "mode"};
inline constexpr PerDistribution<const char*> distribution_titles = {"inclination", "angular speed",
                                                                     "still, swinging, turning over"};

/// Number of equal intervals of the inclination, from 0 to pi/2, in a Histogram.
inline constexpr std::size_t inclination_bins = 90;
/// Number of intervals in a Histogram: those of the angular speed, even in its logarithm from 1e-3 to 1e5
/// rad/s.
inline constexpr std::size_t histogram_bins = 180;
/// The time (s), or share of it, that a quantity spends in each interval. The inclination uses the first
/// inclination_bins, the mode the first three.
using Histogram = std::array<double, histogram_bins>;

/// Metrics of one fall over its window, with errors estimated from the fall's own swings: by the jackknife
/// with a third of the swings left out at a time, 16 at most, since swings that follow one another are alike.
/// No error where the window shows fewer than three swings.
///
/// Falls whose amplitude comes and goes over many swings scatter more than a short record of one can tell: on
/// 300 falls of an ellipsoid in its own turbulence the errors were 0.5 to 0.7 times the scatter between falls
/// for windows of 5 to 11 swings, 0.7 to 0.9 times for 30.
struct FallMetrics {
    PerMetric<std::optional<Estimate>> metrics;
    std::array<Estimate, quantile_percents.size()> inclination_quantiles;  ///< rad
    PerDistribution<std::vector<Histogram>> histograms;  ///< s in each interval, for each piece of the window
    Spectrum spectrum;                                   ///< swing_spectrum() of the window
    std::size_t pieces = 0;                              ///< independent ones, see pieces_of()
};

/// Returns whether metrics of a subject are defined for a body.
bool tells(MetricSubject subject, const Body& body);

/// Returns a metric of one fall over its window, without its error; nothing where the fall has none, and for
/// those that come from a spectrum.
std::optional<double> metric_value(Metric metric, const FallSeries& record);

/// Returns the metrics of a fall over its window. `segment` (s): length of the spectrum's segments.
FallMetrics fall_metrics(const FallSeries& record, double segment);

/// Returns the spectrum of cos^2 of the inclination, the squared vertical component of the shortest axis,
/// over half its frequency (Hz): so that fluttering and tumbling have their peak at the frequency of
/// Measures, whatever the body's rotation about the vertical. cos^2 is smooth where the folded
/// inclination has corners. `segment` (s): see power_spectrum(). Over the window, without the frames left
/// out.
Spectrum swing_spectrum(const FallSeries& record, double segment, const LeftOut& left_out = {});

}  // namespace samara
