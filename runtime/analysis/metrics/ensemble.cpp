#include "samara/analysis/metrics/ensemble.hpp"

#include <algorithm>
#include <cmath>

#include "samara/core/base/parallel_for.hpp"
#include "samara/motion/inclination.hpp"

namespace samara {
namespace {

constexpr std::size_t most_spots = 256;
constexpr double least_spread = 1e-6;  // relative to the displacement: less is rounding

Vector3d horizontal(const Vector3d& vector, const Vector3d& down) {
    return vector - vector.dot(down) * down;
}

/// Returns the slope of the line of least squares through points.
double slope(const std::vector<double>& x, const std::vector<double>& y) {
    const auto count = static_cast<double>(x.size());
    double mean_x = 0.0;
    double mean_y = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        mean_x += x[i] / count;
        mean_y += y[i] / count;
    }
    double product = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        product += (x[i] - mean_x) * (y[i] - mean_y);
        square += (x[i] - mean_x) * (x[i] - mean_x);
    }
    return product / square;
}

}  // namespace

void Ensemble::add(const Motion& motion, const BodyMotion& body, int threads) {
    const auto copies = static_cast<std::size_t>(body.copies);
    const std::size_t count = static_cast<std::size_t>(motion.runs) * copies;
    const auto run = [&](std::size_t i) { return static_cast<int>(i / copies); };
    const auto copy = [&](std::size_t i) { return static_cast<int>(i % copies); };
    std::vector<Measures> each(count);
    std::vector<TimeWindow> falls(count);
    parallel_for(count, 8, threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            each[i] = measure(motion, body, run(i), copy(i));
            falls[i] = fall_of(motion, body, run(i), copy(i));
        }
    });
    for (std::size_t i = 0; i < count; ++i) {
        const bool shorter = falls[i].end - falls[i].begin < shortest_fall_.end - shortest_fall_.begin;
        if (sums_.samples == 0 || shorter) shortest_fall_ = falls[i];
        add_measures(each[i]);
        add_path(motion, body, run(i), copy(i));
        add_landing(motion, body, run(i), copy(i));
    }
}

void Ensemble::add_measures(const Measures& one) {
    ++sums_.samples;
    sums_.mean_velocity += one.mean_velocity;
    for (const CataloguedMetric& entry : metric_catalogue) {
        const auto value = entry.measured ? entry.measured(one) : std::nullopt;
        if (!value) continue;
        MetricSum& sum = metrics_[entry.metric];
        sum.sum += *value;
        sum.squares += *value * *value;
        ++sum.count;
    }
    sums_.regimes.add(one.regime);
}

void Ensemble::add_path(const Motion& motion, const BodyMotion& body, int run, int copy) {
    const std::size_t frames = motion.times.size();
    if (spots_.empty()) {
        spots_.resize(std::min(most_spots, frames));
        for (std::size_t i = 0; i < spots_.size(); ++i) {
            spots_[i].time = motion.times[i * (frames - 1) / std::max<std::size_t>(spots_.size() - 1, 1)];
        }
    }
    const Vector3d down = down_direction(motion.gravity);
    const Vector3d start = motion.pose(body, run, 0, copy).position;
    for (std::size_t i = 0; i < spots_.size(); ++i) {
        const std::size_t frame = i * (frames - 1) / std::max<std::size_t>(spots_.size() - 1, 1);
        const Vector3d displacement =
            horizontal(motion.pose(body, run, static_cast<int>(frame), copy).position - start, down);
        spots_[i].displacement += displacement;
        spots_[i].square += displacement.squaredNorm();
    }
}

void Ensemble::add_landing(const Motion& motion, const BodyMotion& body, int run, int copy) {
    const auto frame = landing_frame(motion, body, run, copy);
    if (!frame) return;
    const Pose& last = motion.pose(body, run, motion.frames() - 1, copy);
    const Vector3d place = motion.pose(body, run, *frame, copy).position;
    ++sums_.landing.count;
    sums_.landing.at_rest += last.velocity.isZero(1e-9) && last.angular_velocity.isZero(1e-9) ? 1 : 0;
    sums_.landing.mean += place;
    squared_landings_ += place.head<2>().squaredNorm();
}

double Ensemble::spread_at(const Spot& spot) const {
    const double count = sums_.samples;
    const double square = spot.square / count;
    const double spread = square - (spot.displacement / count).squaredNorm();
    return spread > least_spread * least_spread * square ? std::sqrt(spread) : 0.0;
}

void Ensemble::measure_path(BodyMeasures& all) const {
    const double begin = shortest_fall_.begin;
    const double end = shortest_fall_.end;
    std::vector<double> times;
    std::vector<double> spreads;
    for (const Spot& spot : spots_) {
        if (spot.time > end) break;
        const double spread = spread_at(spot);
        all.path_spread = spread;
        if (spot.time < begin + (end - begin) / 3.0 || spot.time <= begin || spread == 0.0) continue;
        times.push_back(std::log(spot.time - begin));
        spreads.push_back(std::log(spread));
    }
    if (times.size() >= 2) all.path_spread_growth = slope(times, spreads);
}

Estimate Ensemble::MetricSum::mean(Mean mean) const {
    Estimate all{mean == Mean::arithmetic ? sum / count : std::sqrt(squares / count), {}, {}};
    if (count == 1) return all;
    all.deviation = std::sqrt(std::max(0.0, (squares - sum * sum / count) / (count - 1)));
    all.error = *all.deviation / std::sqrt(count);
    return all;
}

BodyMeasures Ensemble::measures() const {
    BodyMeasures all = sums_;
    const int count = all.samples;
    all.mean_velocity /= count;
    for (const CataloguedMetric& entry : metric_catalogue) {
        const MetricSum& sum = metrics_[entry.metric];
        if (sum.count > 0) all.metrics[entry.metric] = sum.mean(entry.mean);
    }
    if (count > 1) measure_path(all);
    Landing& landing = all.landing;
    if (landing.count > 0) {
        landing.mean /= landing.count;
        const double square = squared_landings_ / landing.count - landing.mean.head<2>().squaredNorm();
        landing.spread = std::sqrt(std::max(0.0, square));
    }
    return all;
}

BodyMeasures measure_all(const Motion& motion, const BodyMotion& body) {
    Ensemble ensemble;
    ensemble.add(motion, body);
    return ensemble.measures();
}

std::vector<BodyMeasures> measure_file(const MotionReader& file, int threads,
                                       const std::function<void(double, double)>& progress) {
    const Motion& motion = file.motion();
    double total = 0.0;
    for (const BodyMotion& body : motion.bodies) total += body.copies;
    total *= static_cast<double>(motion.runs) * motion.frames();
    double done = 0.0;
    std::vector<BodyMeasures> measures;
    for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
        Ensemble ensemble;
        file.for_each_block(i, [&](const Motion& part, const PoseBlock& /*block*/) {
            ensemble.add(part, part.bodies[0], threads);
            done += static_cast<double>(part.bodies[0].poses.size());
            progress(done, total);
        });
        measures.push_back(ensemble.measures());
    }
    return measures;
}

}  // namespace samara
