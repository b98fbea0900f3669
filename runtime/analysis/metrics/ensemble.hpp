#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "samara/analysis/metrics/metric_catalogue.hpp"
#include "samara/motion/motion_file.hpp"

namespace samara {

/// Statistics of the places where copies first touched the ground.
struct Landing {
    int count = 0;                     ///< number of copies and runs that landed
    int at_rest = 0;                   ///< number of copies and runs at rest at the last frame
    Vector3d mean = Vector3d::Zero();  ///< m, world: mean place of the centre of mass when it landed
    double spread = 0.0;               ///< m: rms horizontal distance from `mean`
};

/// Statistics of all copies and runs of a body, each in its own default window.
struct BodyMeasures {
    int samples = 0;                             ///< copies x runs
    Vector3d mean_velocity = Vector3d::Zero();   ///< m/s, mean over copies and runs
    PerMetric<std::optional<Estimate>> metrics;  ///< means of the metrics of
                                                 ///< Measures over the falls that have them
    RegimeCounts regimes;
    double path_spread = 0.0;  ///< m: rms horizontal distance from the mean path, starts laid on one another,
                               ///< at the end of the shortest fall; 0 for a single one
    std::optional<double> path_spread_growth;  ///< p where that distance grows like time^p over the last two
                                               ///< thirds of the shortest fall: 1 for straight paths, 1/2 for
                                               ///< a random walk; nothing where nothing spreads
    Landing landing;

    /// Returns the mean of a metric that every fall has.
    [[nodiscard]] double value(Metric metric) const { return metrics[metric]->value; }
};

/// Gathers the measures of a body's copies and runs, in parts: what it keeps grows neither with time
/// nor with copies and runs.
class Ensemble {
  public:
    /// Adds all copies and runs of `body` in `motion`, which may be parts of the whole; in the order of the
    /// calls. `threads`: 0 for all cores, with the same result for any number.
    void add(const Motion& motion, const BodyMotion& body, int threads = 1);
    /// Returns the statistics of the copies and runs that were added.
    [[nodiscard]] BodyMeasures measures() const;

  private:
    /// Sums over the copies and runs at one time.
    struct Spot {
        double time = 0.0;
        Vector3d displacement = Vector3d::Zero();  ///< m, horizontal, since the start
        double square = 0.0;                       ///< m^2
    };
    /// Sums of one metric over the falls that have it.
    struct MetricSum {
        double sum = 0.0;
        double squares = 0.0;
        int count = 0;

        [[nodiscard]] Estimate mean(Mean mean) const;
    };
    void add_path(const Motion& motion, const BodyMotion& body, int run, int copy);
    void add_landing(const Motion& motion, const BodyMotion& body, int run, int copy);
    void add_measures(const Measures& one);
    [[nodiscard]] double spread_at(const Spot& spot) const;
    void measure_path(BodyMeasures& all) const;

    BodyMeasures sums_;
    PerMetric<MetricSum> metrics_;
    std::vector<Spot> spots_;
    TimeWindow shortest_fall_;
    double squared_landings_ = 0.0;
};

/// Measures all runs and copies of a body.
BodyMeasures measure_all(const Motion& motion, const BodyMotion& body);

/// Measures every body of a file, which is read in parts. `progress` is called with the poses done and in
/// total. `threads`: 0 for all cores.
std::vector<BodyMeasures> measure_file(const MotionReader& file, int threads,
                                       const std::function<void(double done, double total)>& progress);

}  // namespace samara
