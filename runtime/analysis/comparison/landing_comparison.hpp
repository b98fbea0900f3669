#pragma once

#include <vector>

#include "samara/analysis/metrics/estimate.hpp"
#include "samara/analysis/metrics/fall_series.hpp"

namespace samara {

/// Statistics of the passages of falls through a level below their release.
struct Landings {
    Estimate time;                     ///< s since the release
    Estimate scatter;                  ///< m: rms horizontal distance from the mean place
    Vector3d mean = Vector3d::Zero();  ///< m: mean place, horizontal, from the release
};

/// The landings of two sets of falls on one level.
struct LandingComparison {
    double depth = 0.0;  ///< m: depth of the level
    Landings motion;
    Landings reference;
    double distance = 0.0;  ///< m: energy distance of the two sets of places
    Chance chance;          ///< distances of two sets into which all of these falls are divided at random
};

/// Least number of falls on a side from which a scatter is estimated.
inline constexpr std::size_t fewest_landings = 3;

/// Compares passages through the level `depth` (m); three at least on each side. The scatter is unbiased for
/// independent falls, its error by the jackknife. The distance of the places is the energy distance, which is
/// zero for equal distributions alone: 2 E|x - y| - E|x - x'| - E|y - y'| (Szekely and Rizzo, Energy
/// statistics, Journal of Statistical Planning and Inference 143, 2013); of the first 200 falls of each side.
/// Deterministic.
LandingComparison compare_landings(double depth, const std::vector<Passage>& motion,
                                   const std::vector<Passage>& reference);

}  // namespace samara
