#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "samara/analysis/comparison/distribution_distance.hpp"
#include "samara/analysis/metrics/fall_metrics.hpp"
#include "samara/analysis/metrics/first_swing.hpp"
#include "samara/analysis/metrics/passages.hpp"
#include "samara/analysis/metrics/regime_counts.hpp"
#include "samara/motion/motion_file.hpp"

namespace samara {

/// Which falls of a motion file are taken: those of one body, in one run or in all, of one copy or of all.
struct FallChoice {
    std::string name;  ///< of the file, for messages
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

/// What is known of the falls before a window is chosen.
struct FallLengths {
    double shortest = 0.0;    ///< s
    double longest = 0.0;     ///< s
    double shallowest = 0.0;  ///< m: what the least deep of them descends
};

/// Throws Error, naming the file, where a fall's frames are too far apart to see how the shortest axis turns:
/// a quarter of a turn from one to the next.
FallLengths fall_lengths(const FallChoice& choice);

/// How falls are measured.
struct FallWindow {
    TimeWindow window;           ///< s since the release
    double segment = 0.0;        ///< s, of the spectra: see swing_spectrum()
    std::vector<double> depths;  ///< m: of the levels whose passages are noted, see passages_of()
};

/// What the chosen falls do together: the means over those that differ from one another. A set of one has the
/// errors that its swings tell, of several those that their scatter tells.
struct FallSet {
    int falls = 0;     ///< that were chosen
    int distinct = 0;  ///< of them, to a ten-millionth of the way: the rest repeat these and do not count
    PerMetric<std::optional<Estimate>> metrics;
    std::array<Estimate, quantile_percents.size()> inclination_quantiles;
    PieceHistograms histograms;                ///< of all pieces
    Spectrum spectrum;                         ///< mean
    std::size_t pieces = 0;                    ///< independent ones in all
    RegimeCounts regimes;                      ///< of the distinct falls
    FirstSwing first_swing;                    ///< means over the falls that show its turning points
    std::optional<Estimate> path_distance;     ///< m, from the path given, see measure_falls()
    FallSeries example;                        ///< the first fall
    std::vector<FallSeries> more;              ///< some of the others, for pictures
    std::vector<Vector3d> mean_displacements;  ///< m, at the example's times
    /// By level, of the distinct falls that pass it.
    std::vector<std::vector<Passage>> passages;
};

/// `path`: of another motion, and until when (s since the release) the distance from it is measured.
FallSet measure_falls(const FallChoice& choice, const FallWindow& window,
                      const std::optional<std::pair<const FallSeries*, double>>& path,
                      const std::function<void()>& progress);

}  // namespace samara
