#pragma once

#include <optional>
#include <vector>

#include "samara/motion/fall_figures.hpp"

namespace samara {

/// How far apart two distributions of the inclination are.
struct DistributionDistance {
    double distance = 0.0;               ///< largest difference of the distribution functions (Kolmogorov's)
    std::optional<double> by_chance;     ///< its mean for two falls of one kind with as many swings
    std::optional<double> chance_limit;  ///< 95 % of such falls are nearer
    std::optional<double> probability;   ///< share of such falls that are as far apart or farther
};

/// That of two falls, or sets of falls, from the histograms of their independent pieces. What chance does is
/// found by drawing as many pieces as each has at random from those of both, 999 times, as in a permutation
/// test (Romano, Bootstrap and randomization tests of some nonparametric hypotheses, Annals of Statistics 17,
/// 1989): frames within a swing are not independent, so that the formula of Kolmogorov and Smirnov does not
/// hold for them. Nothing of chance for fewer than three pieces on a side. The same result every time.
DistributionDistance distribution_distance(const std::vector<InclinationHistogram>& motion,
                                           const std::vector<InclinationHistogram>& reference);

}  // namespace samara
