#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "samara/motion/measures.hpp"
#include "samara/motion/motion_file.hpp"

namespace samara {

/// Where the copies that reached the ground first touched it.
struct Landing {
    int count = 0;                     ///< of copies and runs that landed
    int at_rest = 0;                   ///< of copies and runs that lie still at the last frame
    Vector3d mean = Vector3d::Zero();  ///< m, world: mean place of the centre of mass when it landed
    double spread = 0.0;               ///< m: rms horizontal distance from it
};

/// What all copies and runs of a body do together, each in its own default window.
struct BodyMeasures {
    int samples = 0;                            ///< copies x runs
    Vector3d mean_velocity = Vector3d::Zero();  ///< m/s, mean over copies and runs
    double descent_speed = 0.0;                 ///< m/s, mean over copies and runs
    double descent_speed_deviation = 0.0;       ///< m/s, standard deviation between them; 0 for a single one
    double descent_speed_error = 0.0;           ///< m/s, standard error of the mean; 0 for a single one
    double mean_inclination = 0.0;              ///< rad, mean over copies and runs
    double inclination_amplitude = 0.0;         ///< rad, mean over copies and runs
    std::optional<double> frequency;            ///< Hz, mean over those that have one
    double frequency_deviation = 0.0;           ///< Hz, standard deviation between them; 0 for a single one
    double rms_angular_speed = 0.0;             ///< rad/s, root of the mean square
    Regime regime = Regime::steady;             ///< the commonest; the first in the enumeration of equals
    double regime_share = 1.0;                  ///< of the copies and runs that fall like that
    std::array<double, 2> regime_confidence = {0.0,
                                               1.0};  ///< 95 % interval of the share: see wilson_interval
    std::array<int, 4> regime_counts = {};  ///< copies and runs of each regime, in the enumeration's order
    double path_spread = 0.0;  ///< m: rms horizontal distance from the mean path, starts laid on one another,
                               ///< at the end of the shortest fall; 0 for a single one
    std::optional<double> path_spread_growth;  ///< p where that distance grows like time^p over the last two
                                               ///< thirds of the shortest fall: 1 for straight paths, 1/2 for
                                               ///< a random walk; nothing where nothing spreads
    Landing landing;
};

/// The interval (from, to) that holds the probability of an outcome seen `count` times in `samples` with 95 %
/// confidence: Wilson, Probable inference, the law of succession, and statistical inference, JASA 22, 1927.
std::array<double, 2> wilson_interval(int count, int samples);

/// Gathers the measures of a body's copies and runs, in parts: what it keeps grows neither with time
/// nor with copies and runs.
class Ensemble {
  public:
    /// All copies and runs of `body` in `motion`, which may be parts of the whole; in the order of the calls.
    /// `threads`: 0 for all cores, with the same result for any number.
    void add(const Motion& motion, const BodyMotion& body, int threads = 1);
    [[nodiscard]] BodyMeasures measures() const;

  private:
    /// Sums over the copies and runs at one time.
    struct Spot {
        double time = 0.0;
        Vector3d way = Vector3d::Zero();  ///< m, horizontal, since the start
        double square = 0.0;              ///< m^2
    };
    void add_path(const Motion& motion, const BodyMotion& body, int run, int copy);
    void add_landing(const Motion& motion, const BodyMotion& body, int run, int copy);
    void add_measures(const Measures& one);
    [[nodiscard]] double spread_at(const Spot& spot) const;
    void measure_path(BodyMeasures& all) const;

    BodyMeasures sums_;
    double squared_speeds_ = 0.0;
    double squared_frequencies_ = 0.0;
    double frequencies_ = 0.0;
    double squared_spins_ = 0.0;
    int with_frequency_ = 0;
    std::vector<Spot> spots_;
    TimeWindow shortest_fall_;
    double squared_landings_ = 0.0;
};

/// The ensemble of all runs and copies of a body.
BodyMeasures measure_all(const Motion& motion, const BodyMotion& body);

/// Those of every body of a file, which is read in parts. `progress` is told of (done, total) poses.
/// `threads`: 0 for all cores.
std::vector<BodyMeasures> measure_file(const MotionReader& file, int threads,
                                       const std::function<void(double done, double total)>& progress);

}  // namespace samara
