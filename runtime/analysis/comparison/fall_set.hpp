#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "samara/analysis/comparison/distribution_distance.hpp"
#include "samara/analysis/metrics/fall_metrics.hpp"
#include "samara/analysis/metrics/fall_series.hpp"
#include "samara/analysis/metrics/metric_catalogue.hpp"
#include "samara/motion/motion_file.hpp"

namespace samara {

/// A choice of falls of a motion file: those of one body, in one run or in all, of one copy or of all.
struct FallChoice {
    std::string name;  ///< name of the file, for messages
    const MotionReader* file = nullptr;
    std::size_t body = 0;
    std::optional<int> run;
    std::optional<int> copy;

    [[nodiscard]] const Motion& motion() const { return file->motion(); }
    [[nodiscard]] const BodyMotion& of_body() const { return motion().bodies[body]; }
    [[nodiscard]] int runs() const { return run ? 1 : motion().runs; }
    [[nodiscard]] int copies() const { return copy ? 1 : of_body().copies; }
};

/// Calls `use` for one chosen fall after the other, which are read in parts: (part of the motion that holds
/// the body as its one body, run and copy in the part).
void for_each_fall(const FallChoice& choice,
                   const std::function<void(const Motion& part, int run, int copy)>& use);

/// Durations and depth of the falls, from which a window is chosen.
struct FallLengths {
    double shortest = 0.0;    ///< s
    double longest = 0.0;     ///< s
    double shallowest = 0.0;  ///< m: least depth that a fall descends
};

/// Returns the durations and least depth of the falls. Throws Error, naming the file, where the shortest axis
/// rotates by more than a quarter of a revolution from frame to frame.
FallLengths fall_lengths(const FallChoice& choice);

/// The window over which falls are measured, and its parts.
struct FallWindow {
    TimeWindow window;           ///< s since the release
    double segment = 0.0;        ///< s, of the spectra: see swing_spectrum()
    std::vector<double> depths;  ///< m: levels whose passages are noted, see passages_of()
};

/// Statistics of the chosen falls: means over those that differ from one another. The errors of a single fall
/// come from its swings, those of several from their scatter.
struct FallSet {
    int falls = 0;  ///< number of falls that were chosen
    int distinct =
        0;  ///< number of different falls, to a ten-millionth of the displacement: repetitions do not count
    PerMetric<std::optional<Estimate>> metrics;
    std::array<Estimate, quantile_percents.size()> inclination_quantiles;
    PerDistribution<PieceHistograms> histograms;  ///< histograms of all pieces
    Spectrum spectrum;                            ///< mean
    std::size_t pieces = 0;                       ///< number of independent pieces of all falls
    RegimeCounts regimes;                         ///< regimes of the distinct falls
    FirstSwing first_swing;                       ///< means over the falls that have its turning points
    std::optional<Estimate> path_distance;        ///< m, from the path given, see measure_falls()
    FallSeries example;                           ///< the first fall
    std::vector<FallSeries> more;                 ///< some of the others, for pictures
    std::vector<Vector3d> mean_displacements;     ///< m, at the example's times
    /// Passages of the distinct falls, level by level.
    std::vector<std::vector<Passage>> passages;
};

/// Measures the chosen falls. `path`: another fall and the time (s since the release) until which the
/// distance from it is measured. `progress` is called after each fall.
FallSet measure_falls(const FallChoice& choice, const FallWindow& window,
                      const std::optional<std::pair<const FallSeries*, double>>& path,
                      const std::function<void()>& progress);

}  // namespace samara
