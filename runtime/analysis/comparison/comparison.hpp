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

/// Returns the usual tolerances, relative to the reference: in the proportions of the catalogue, 0.1 for the
/// descent speed.
constexpr PerMetric<double> usual_tolerances() {
    PerMetric<double> tolerances{};
    for (const Metric metric : compared_metrics) tolerances[metric] = catalogued(metric).allowed.share / 10.0;
    return tolerances;
}

/// Settings of compare().
struct ComparisonSettings {
    std::optional<TimeWindow> window;  ///< s since the release; default: the last two thirds of the shortest
                                       ///< fall of either file
    PerMetric<double> tolerances =
        usual_tolerances();  ///< relative, of compared_metrics; the catalogue's absolute tolerances are added
};

/// Whether a difference is within its tolerance.
struct Verdict {
    double limit = 0.0;   ///< largest difference allowed, in the metric's unit
    bool agrees = false;  ///< whether the
                          ///< difference beyond the reference's own uncertainty is within the limit
    bool certain =
        false;  ///< whether
                ///< the verdict holds for every true value of the reference within its uncertainty, by two
                ///< standard errors of the difference uncertainty, by two standard errors of the difference
};

/// One metric of the motion and of the reference.
struct MetricComparison {
    std::optional<Estimate> motion;
    std::optional<Estimate> reference;
    std::optional<double> difference;        ///< motion - reference
    std::optional<double> difference_error;  ///< standard error: see compare_metric()
    std::optional<double> relative;          ///< difference over the reference's magnitude
    std::optional<double> in_errors;         ///< the difference's magnitude over its standard error
    double reference_uncertainty = 0.0;  ///< uncertainty of the reference by all causes together, in its unit
    std::optional<Verdict> verdict;      ///< nothing where there is no tolerance for the metric
};

/// The distributions of one quantity of both sides.
struct DistributionComparison {
    DistributionDistance distance;
    /// Where falls are judged by their distributions: whether they are no further apart than
    /// largest_distribution_distance beyond what chance gives.
    std::optional<Verdict> verdict;
};

/// The share of the time by which distributions may differ beyond chance.
inline constexpr double largest_distribution_distance = 0.2;

/// Comparison of the first swings, and of the paths until the later turning point of the reference's. Members
/// are nothing where one of the two has none.
struct FirstSwingComparison {
    MetricComparison minimum_time;          ///< s since the release
    MetricComparison minimum_inclination;   ///< rad
    MetricComparison maximum_time;          ///< s
    MetricComparison maximum_inclination;   ///< rad
    std::optional<double> end;              ///< s since the release: end of the comparison of the paths
    std::optional<Estimate> path_distance;  ///< m, rms
    std::optional<double> distance_fallen;  ///< m, of the reference along gravity by then
};

/// The comparison of a motion with a reference.
struct Comparison {
    std::string motion_body;
    std::string reference_body;
    TimeWindow window;  ///< s since the release, of both
    FallLengths motion_lengths;
    FallLengths reference_lengths;
    FallSet motion;
    FallSet reference;
    PerMetric<MetricComparison> metrics;
    std::array<MetricComparison, quantile_percents.size()> quantiles;  ///< quantiles of the inclination (rad)
    PerDistribution<DistributionComparison> distributions;
    FirstSwingComparison first_swing;
    /// At a quarter, a half, three quarters and the whole of the depth that all falls reach; none where
    /// either side has fewer than fewest_landings.
    std::vector<LandingComparison> landings;
    bool judges_inclination = true;  ///< false for bodies without a shortest axis, such as spheres: then only
                                     ///< the descent speed has a verdict
    bool regimes_agree = false;
    bool regime_is_uncertain =
        false;  ///< whether the reference's regime depends on its mesh or closure: then it is not judged
    /// Why frequency, amplitude and regime of a single fall tell little here, so that `agrees` rests on the
    /// distributions; empty where it rests on the metrics.
    std::string irregular_because;
    bool agrees_by_metrics =
        false;            ///< whether all metrics agree and, where the inclination is judged, the regimes
    bool agrees = false;  ///< by the metrics, or of irregular falls by descent speed, drift and distributions
    bool certain = false;  ///<
                           ///< whether `agrees` would be the same without the verdicts that are not certain
    std::vector<std::string> notes;  ///< limits of the comparison's validity, a sentence each
};

/// Compares the falls of a motion with those of a reference. Falls are chaotic: statistics over the window
/// are compared, each with its standard error, and the first swing as a path. `progress` is called with the
/// falls done and in total. Throws Error where gravity differs, where the window is not covered by both,
/// where a fall is shorter than two frames, and where frames are too far apart.
Comparison compare(const FallChoice& motion, const FallChoice& reference, const ComparisonSettings& settings,
                   const std::function<void(double done, double total)>& progress);

/// Compares one metric. Where one estimate is of a single fall and the other of several, the error of the
/// single one counts as no less than the deviation of the others: its own swings may tell too little. The
/// tolerance's limit is `tolerance` of the reference's magnitude, `least_limit` at least; no verdict where it
/// is not given, or where neither has the metric. `uncertainty`: of the reference, relative to its magnitude.
MetricComparison compare_metric(const std::optional<Estimate>& motion,
                                const std::optional<Estimate>& reference,
                                const std::optional<double>& tolerance = {}, double least_limit = 0.0,
                                double uncertainty = 0.0);

}  // namespace samara
