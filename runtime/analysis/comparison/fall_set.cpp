#include "samara/analysis/comparison/fall_set.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/motion/inclination.hpp"

namespace samara {
namespace {

constexpr std::size_t most_more = 19;
constexpr double same_displacement = 1e-7;

/// Values that two falls share only if they are the same.
using Mark = std::array<long long, 4>;

Mark mark_of(const FallSeries& record) {
    const Vector3d& displacement = record.displacements.back();
    const double scale = same_displacement * std::max(displacement.norm(), 1e-300);
    return {std::llround(displacement.x() / scale), std::llround(displacement.y() / scale),
            std::llround(displacement.z() / scale),
            std::llround(record.inclinations.back() / same_displacement)};
}

/// Returns the largest angular speed (rad/s) of the shortest axis in a fall.
double fastest_axis_rotation(const Motion& motion, int run, int copy, const TimeWindow& fall) {
    const BodyMotion& body = motion.bodies[0];
    double fastest = 0.0;
    for (int frame = 0; frame < motion.frames(); ++frame) {
        const double time = motion.times[static_cast<std::size_t>(frame)];
        if (time < fall.begin || time > fall.end) continue;
        const Pose& pose = motion.pose(body, run, frame, copy);
        fastest =
            std::max(fastest, pose.angular_velocity.cross(pose.orientation * body.shortest_axis).norm());
    }
    return fastest;
}

/// Returns the largest depth (m) of the centre of mass below its release in a fall.
double deepest(const Motion& motion, int run, int copy, const TimeWindow& fall) {
    const Vector3d down = down_direction(motion.gravity);
    std::optional<double> release;
    double deepest = 0.0;
    for (int frame = 0; frame < motion.frames(); ++frame) {
        const double time = motion.times[static_cast<std::size_t>(frame)];
        if (time < fall.begin || time > fall.end) continue;
        const double depth = motion.pose(motion.bodies[0], run, frame, copy).position.dot(down);
        if (!release) release = depth;
        deepest = std::max(deepest, depth - *release);
    }
    return deepest;
}

void require_frame_rate(const FallChoice& choice, double fastest) {
    const std::vector<double>& times = choice.motion().times;
    double longest = 0.0;
    for (std::size_t i = 1; i < times.size(); ++i) longest = std::max(longest, times[i] - times[i - 1]);
    const double angle = fastest * longest;
    if (angle <= 0.5 * std::numbers::pi) return;
    throw Error(fmt::format(
        "{}: '{}' rotates by up to {:.0f} degrees between frames, too much to be tracked; write the motion "
        "with a frame_rate of {:.0f} or more",
        choice.name, choice.of_body().name, angle * degrees, std::ceil(fastest / (std::numbers::pi / 6.0))));
}

/// Estimates of one metric, fall by fall.
using Estimates = std::vector<Estimate>;

/// Gathers falls; FallSet is what it comes to.
class Gathering {
  public:
    Gathering(const FallWindow& window, const std::optional<std::pair<const FallSeries*, double>>& path)
        : window_(window), path_(path) {
        set_.passages.resize(window_.depths.size());
    }

    void add(FallSeries&& record) {
        ++set_.falls;
        if (!marks_.insert(mark_of(record)).second) return;
        add_metrics(record);
        add_first_swing(record);
        if (path_) distances_.push_back({path_distance(record, *path_->first, path_->second), {}, {}});
        set_.regimes.add(record.measures.regime);
        const std::vector<Passage> passages = passages_of(record, window_.depths);
        for (std::size_t i = 0; i < passages.size(); ++i) set_.passages[i].push_back(passages[i]);
        if (marks_.size() == 1) {
            set_.mean_displacements.assign(record.times.size(), Vector3d::Zero());
            set_.example = record;
        }
        for (std::size_t i = 0; i < set_.mean_displacements.size(); ++i) {
            set_.mean_displacements[i] += displacement_at(record, set_.example.times[i]);
        }
        if (marks_.size() > 1 && set_.more.size() < most_more) set_.more.push_back(std::move(record));
    }

    FallSet result() {
        set_.distinct = static_cast<int>(marks_.size());
        for (const CataloguedMetric& entry : metric_catalogue) {
            set_.metrics[entry.metric] = mean_of(metrics_[entry.metric], entry.mean);
        }
        for (std::size_t q = 0; q < quantile_percents.size(); ++q) {
            set_.inclination_quantiles[q] = mean_of(quantiles_[q]).value_or(Estimate{});
        }
        for (Vector3d& displacement : set_.mean_displacements) displacement /= set_.distinct;
        for (double& power : set_.spectrum.power) power /= set_.distinct;
        set_.path_distance = mean_of(distances_);
        set_.first_swing = {turning_point(minima_), turning_point(maxima_)};
        return std::move(set_);
    }

  private:
    struct TurningPoints {
        Estimates times;
        Estimates inclinations;
    };

    void add_metrics(const FallSeries& record) {
        FallMetrics one = fall_metrics(record, window_.segment);
        for (std::size_t i = 0; i < metric_count; ++i) {
            if (one.metrics[i]) metrics_[i].push_back(*one.metrics[i]);
        }
        for (std::size_t q = 0; q < quantile_percents.size(); ++q) {
            quantiles_[q].push_back(one.inclination_quantiles[q]);
        }
        for (std::size_t i = 0; i < set_.histograms.size(); ++i) {
            set_.histograms[i].push_back(std::move(one.histograms[i]));
        }
        set_.pieces += one.pieces;
        add_power(set_.spectrum, one.spectrum);
    }

    void add_first_swing(const FallSeries& record) {
        const FirstSwing swing = first_swing(record);
        const auto add_point = [](TurningPoints& points, const std::optional<TurningPoint>& point) {
            if (!point) return;
            points.times.push_back(point->time);
            points.inclinations.push_back(point->inclination);
        };
        add_point(minima_, swing.minimum);
        add_point(maxima_, swing.maximum);
    }

    static std::optional<TurningPoint> turning_point(const TurningPoints& points) {
        if (points.times.empty()) return std::nullopt;
        return TurningPoint{*mean_of(points.times), *mean_of(points.inclinations)};
    }

    FallWindow window_;
    std::optional<std::pair<const FallSeries*, double>> path_;
    FallSet set_;
    std::set<Mark> marks_;
    PerMetric<Estimates> metrics_;
    std::array<Estimates, quantile_percents.size()> quantiles_;
    Estimates distances_;
    TurningPoints minima_;
    TurningPoints maxima_;
};

}  // namespace

void for_each_fall(const FallChoice& choice,
                   const std::function<void(const Motion& part, int run, int copy)>& use) {
    if (choice.run && choice.copy) {
        Motion part = choice.motion();
        part.bodies = {choice.of_body()};
        part.bodies[0].sizes = {choice.of_body().size(*choice.run, *choice.copy)};
        part.bodies[0].copies = 1;
        part.bodies[0].poses = choice.file->poses(choice.body, {*choice.run, 1, *choice.copy, 1});
        part.runs = 1;
        use(part, 0, 0);
        return;
    }
    choice.file->for_each_block(choice.body, [&](const Motion& part, const PoseBlock& block) {
        for (int run = 0; run < block.runs; ++run) {
            if (choice.run && block.first_run + run != *choice.run) continue;
            for (int copy = 0; copy < block.copies; ++copy) {
                if (choice.copy && block.first_copy + copy != *choice.copy) continue;
                use(part, run, copy);
            }
        }
    });
}

FallLengths fall_lengths(const FallChoice& choice) {
    std::optional<FallLengths> lengths;
    double fastest = 0.0;
    for_each_fall(choice, [&](const Motion& part, int run, int copy) {
        const TimeWindow fall = fall_of(part, part.bodies[0], run, copy);
        const double length = fall.end - fall.begin;
        const double depth = deepest(part, run, copy, fall);
        if (!lengths) lengths = FallLengths{length, length, depth};
        lengths->shallowest = std::min(lengths->shallowest, depth);
        lengths->shortest = std::min(lengths->shortest, length);
        lengths->longest = std::max(lengths->longest, length);
        fastest = std::max(fastest, fastest_axis_rotation(part, run, copy, fall));
    });
    require_frame_rate(choice, fastest);
    return *lengths;
}

FallSet measure_falls(const FallChoice& choice, const FallWindow& window,
                      const std::optional<std::pair<const FallSeries*, double>>& path,
                      const std::function<void()>& progress) {
    Gathering gathering(window, path);
    for_each_fall(choice, [&](const Motion& part, int run, int copy) {
        gathering.add(fall_series(part, part.bodies[0], run, copy, window.window));
        progress();
    });
    return gathering.result();
}

}  // namespace samara
