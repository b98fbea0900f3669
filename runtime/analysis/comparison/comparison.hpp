#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "samara/analysis/comparison/distribution_distance.hpp"
#include "samara/analysis/comparison/fall_set.hpp"
#include "samara/analysis/comparison/landing_comparison.hpp"

namespace samara {

/// How far a motion may be off the reference, relative to it: in the proportions of the catalogue, 0.1 of the
/// descent speed.
constexpr PerMetric<double> usual_tolerances() {
    PerMetric<double> tolerances{};
    for (const Metric metric : compared_metrics) tolerances[metric] = catalogued(metric).allowed.share / 10.0;
    return tolerances;
}

struct ComparisonSettings {
    std::optional<TimeWindow> window;  ///< s since the release; default: the last two thirds of the shortest
                                       ///< fall of either file
    PerMetric<double> tolerances = usual_tolerances();  ///< relative, of compared_metrics; beside them what
                                                        ///< the catalogue always allows
};

/// Whether a difference is within its tolerance.
struct Verdict {
    double limit = 0.0;    ///< of the difference, in the figure's unit
    bool agrees = false;   ///< what lies beyond the reference's own uncertainty is within the limit
    bool certain = false;  ///< and would be, or not be, whatever the reference's true figure is within its
                           ///< uncertainty, by two standard errors of the difference
};

/// One figure of the motion beside that of the reference.
struct MetricComparison {
    std::optional<Estimate> motion;
    std::optional<Estimate> reference;
    std::optional<double> difference;        ///< motion - reference
    std::optional<double> difference_error;  ///< standard error: see compare_metric()
    std::optional<double> relative;          ///< difference over the reference's magnitude
    std::optional<double> in_errors;         ///< the difference's magnitude over its standard error
    double reference_uncertainty = 0.0;      ///< of the reference, by all causes together; in its unit
    std::optional<Verdict> verdict;          ///< where there is a tolerance for the figure
};

/// The first swings of both, and how far apart the paths are until the later turning point of the
/// reference's. Nothing where one of the two shows none.
struct FirstSwingComparison {
    MetricComparison minimum_time;          ///< s since the release
    MetricComparison minimum_inclination;   ///< rad
    MetricComparison maximum_time;          ///< s
    MetricComparison maximum_inclination;   ///< rad
    std::optional<double> end;              ///< s since the release: until when the paths are compared
    std::optional<Estimate> path_distance;  ///< m, rms
    std::optional<double> distance_fallen;  ///< m, of the reference along gravity by then
};

/// A motion held against a reference.
struct Comparison {
    std::string motion_body;
    std::string reference_body;
    TimeWindow window;  ///< s since the release, of both
    FallLengths motion_lengths;
    FallLengths reference_lengths;
    FallSet motion;
    FallSet reference;
    PerMetric<MetricComparison> metrics;
    std::array<MetricComparison, quantile_percents.size()> quantiles;  ///< of the inclination (rad)
    DistributionDistance distribution;
    FirstSwingComparison first_swing;
    /// At a quarter, a half, three quarters and the whole of the depth that all falls reach; none where
    /// either side has fewer than fewest_landings.
    std::vector<LandingComparison> landings;
    bool judges_inclination = true;  ///< false for bodies without a shortest axis, such as spheres: then only
                                     ///< the descent speed has a verdict
    bool regimes_agree = false;
    bool regime_is_uncertain =
        false;             ///< the reference's own depends on its mesh or closure: it decides nothing
    bool agrees = false;   ///< all verdicts and, where the inclination is judged, the regimes
    bool certain = false;  ///< whether that would hold without the verdicts that are not certain
    std::vector<std::string> notes;  ///< what to know before trusting the figures, a sentence each
};

/// Falls are chaotic: what is compared are statistics over the window, each with its standard error, and the
/// first swing as a path. `progress` is told of (done, total) falls. Throws Error where gravity differs,
/// where the window is not covered by both, where a fall is shorter than two frames, and where frames are too
/// far apart.
Comparison compare(const FallChoice& motion, const FallChoice& reference, const ComparisonSettings& settings,
                   const std::function<void(double done, double total)>& progress);

/// One figure of two. Where one is of a single fall and the other of several, the error of the single one
/// counts as no less than the deviation of the others: its own swings may tell too little. The tolerance's
/// limit is `tolerance` of the reference's magnitude, `least_limit` at least; no verdict where it is not
/// given, nor of what neither has. `uncertainty`: of the reference, over its magnitude.
MetricComparison compare_metric(const std::optional<Estimate>& motion,
                                const std::optional<Estimate>& reference,
                                const std::optional<double>& tolerance = {}, double least_limit = 0.0,
                                double uncertainty = 0.0);

}  // namespace samara
