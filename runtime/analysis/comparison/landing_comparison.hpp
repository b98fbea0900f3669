#pragma once

#include <vector>

#include "samara/analysis/comparison/chance.hpp"
#include "samara/analysis/metrics/estimate.hpp"
#include "samara/analysis/metrics/passages.hpp"

namespace samara {

/// How falls land on a level below their release.
struct Landings {
    Estimate time;                     ///< s since the release
    Estimate scatter;                  ///< m: rms horizontal distance from the mean place
    Vector3d mean = Vector3d::Zero();  ///< m: that place, horizontal, from the release
};

/// The landings of two sets of falls on one level.
struct LandingComparison {
    double depth = 0.0;  ///< m: of the level
    Landings motion;
    Landings reference;
    double distance = 0.0;  ///< m: energy distance of the two sets of places
    Chance chance;          ///< that of two sets into which all of these falls are divided at random
};

/// Fewer falls than that on a side tell nothing of how they scatter.
inline constexpr std::size_t fewest_landings = 3;

/// Three passages at least on each side. The scatter is unbiased for independent falls, its error that of the
/// jackknife. Places are as far apart as the energy distance says, which is zero for equal distributions
/// alone: 2 E|x - y| - E|x - x'| - E|y - y'| (Szekely and Rizzo, Energy statistics, Journal of Statistical
/// Planning and Inference 143, 2013); of the first 200 falls of each side. The same result every time.
LandingComparison compare_landings(double depth, const std::vector<Passage>& motion,
                                   const std::vector<Passage>& reference);

}  // namespace samara
