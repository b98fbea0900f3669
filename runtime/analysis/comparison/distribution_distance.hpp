#pragma once

#include <optional>
#include <vector>

#include "samara/analysis/metrics/estimate.hpp"
#include "samara/analysis/metrics/fall_metrics.hpp"

namespace samara {

/// Histograms of the pieces of some falls, fall by fall.
using PieceHistograms = std::vector<std::vector<Histogram>>;

/// Distance of two distributions over time, such as of the inclination, and the distances that chance gives
/// between falls of one distribution.
struct DistributionDistance {
    double distance = 0.0;         ///< largest difference of the distribution functions (Kolmogorov's)
    std::optional<Chance> chance;  ///< distances by chance; nothing where they are not known
    bool by_falls = false;         ///< whether chance was seen between falls; else between swings
};

/// Returns the distance of two falls, or sets of falls. For one fall against ten or more, chance is the
/// distance of each of these from the others. Otherwise it is found by drawing as many pieces as each side
/// has at random from those of both, chance_draws times, as in a permutation test: frames within a swing are
/// not independent, so that the formula of Kolmogorov and Smirnov does not hold for them. Chance is nothing
/// for fewer than three pieces on a side. Deterministic.
DistributionDistance distribution_distance(const PieceHistograms& motion, const PieceHistograms& reference);

}  // namespace samara
