#pragma once

#include <optional>

#include "samara/analysis/metrics/estimate.hpp"
#include "samara/analysis/metrics/fall_series.hpp"

namespace samara {

/// A turning point of the inclination.
struct TurningPoint {
    Estimate time;         ///< s since the release; the error is that of reading it from frames
    Estimate inclination;  ///< rad; likewise
};

/// What a body does first: its inclination's first minimum and first maximum after the release. They count by
/// the prominence of the minima of Measures, judged on the whole fall.
struct FirstSwing {
    std::optional<TurningPoint> minimum;
    std::optional<TurningPoint> maximum;
};

FirstSwing first_swing(const FallSeries& record);

/// When the first swing is over (s since the release): at the later of its turning points; nothing where one
/// of them is missing.
std::optional<double> end_of(const FirstSwing& swing);

/// The root of the mean square distance (m) between two falls until `end` (s since the release), both laid on
/// their release points: at the frames of the second, in world axes.
double path_distance(const FallSeries& fall, const FallSeries& reference, double end);

}  // namespace samara
