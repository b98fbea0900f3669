#pragma once

#include <optional>
#include <vector>

#include "samara/analysis/comparison/chance.hpp"
#include "samara/analysis/metrics/fall_metrics.hpp"

namespace samara {

/// The pieces of some falls, fall by fall.
using PieceHistograms = std::vector<std::vector<InclinationHistogram>>;

/// How far apart two distributions of the inclination are, and what chance does between falls of one kind.
struct DistributionDistance {
    double distance = 0.0;         ///< largest difference of the distribution functions (Kolmogorov's)
    std::optional<Chance> chance;  ///< that of such distances
    bool by_falls = false;         ///< whether chance was seen between falls; else between swings
};

/// That of two falls, or sets of falls. Of one fall against ten or more, chance is what each of these is away
/// from the others. Otherwise it is found by drawing as many pieces as each side has at random from those of
/// both, chance_draws times, as in a permutation test: frames within a swing are not independent, so that the
/// formula of Kolmogorov and Smirnov does not hold for them. Nothing of chance for fewer than three pieces on
/// a side. The same result every time.
DistributionDistance distribution_distance(const PieceHistograms& motion, const PieceHistograms& reference);

}  // namespace samara
