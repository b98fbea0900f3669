#include "samara/analysis/metrics/fall_series.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "samara/motion/inclination.hpp"

namespace samara {
namespace {

constexpr std::size_t steady_pieces = 8;

/// Returns the first frame at or after a time.
std::size_t frame_at(const FallSeries& record, double time) {
    const double slack = 1e-9 * std::max(1.0, record.duration());
    const auto place = std::lower_bound(record.times.begin(), record.times.end(), time - slack);
    return std::min(static_cast<std::size_t>(place - record.times.begin()), record.times.size() - 1);
}

/// Returns the stretches between successive frames of a list.
std::vector<Piece> between(const std::vector<std::size_t>& cuts) {
    std::vector<Piece> pieces;
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        if (cuts[i] > cuts[i - 1]) pieces.push_back({cuts[i - 1], cuts[i] + 1});
    }
    return pieces;
}

/// Returns the turning point at a time between frames. Its time lies anywhere within a frame's length, its
/// inclination differs from that of the nearest frame by no more than half of what the next frame's does.
TurningPoint turning_point(const FallSeries& record, double time, bool is_minimum) {
    const auto after = std::lower_bound(record.times.begin() + 1, record.times.end() - 1, time);
    const auto i = static_cast<std::size_t>(after - record.times.begin());
    const auto& angles = record.inclinations;
    const auto first = angles.begin() + static_cast<std::ptrdiff_t>(i) - 1;
    const auto extreme = is_minimum ? std::min_element(first, first + 3) : std::max_element(first, first + 3);
    const auto place = static_cast<std::size_t>(extreme - angles.begin());
    double change = 0.0;
    if (place > 0) change = std::abs(angles[place] - angles[place - 1]);
    if (place + 1 < angles.size()) change = std::max(change, std::abs(angles[place] - angles[place + 1]));
    const double uniform = 1.0 / std::sqrt(12.0);  // deviation of what lies anywhere in an interval
    return {{time, uniform * (record.times[i] - record.times[i - 1]), {}}, {*extreme, uniform * change, {}}};
}

}  // namespace

FallSeries fall_series(const Motion& motion, const BodyMotion& body, int run, int copy,
                       const TimeWindow& window) {
    const TimeWindow fall = fall_of(motion, body, run, copy);
    FallSeries record;
    record.release = fall.begin;
    record.down = down_direction(motion.gravity);
    Vector3d start = Vector3d::Zero();
    for (int frame = 0; frame < motion.frames(); ++frame) {
        const double time = motion.times[static_cast<std::size_t>(frame)];
        if (time < fall.begin || time > fall.end) continue;
        const Pose& pose = motion.pose(body, run, frame, copy);
        if (record.times.empty()) start = pose.position;
        record.times.push_back(time - fall.begin);
        record.displacements.emplace_back(pose.position - start);
        record.inclinations.push_back(inclination(motion, body, pose));
        record.squared_spins.push_back(pose.angular_velocity.squaredNorm());
        record.upright_spins.push_back(pose.angular_velocity.dot(record.down));
        record.axes.emplace_back(pose.orientation * body.shortest_axis);
    }
    record.measures = measure(motion, body, run, copy,
                              TimeWindow{window.begin + record.release, window.end + record.release});
    record.measures.window.begin -= record.release;
    record.measures.window.end -= record.release;
    return record;
}

Vector3d displacement_at(const FallSeries& record, double time) {
    const auto after = std::upper_bound(record.times.begin(), record.times.end(), time);
    if (after == record.times.begin()) return record.displacements.front();
    if (after == record.times.end()) return record.displacements.back();
    const auto i = static_cast<std::size_t>(after - record.times.begin());
    const double share = (time - record.times[i - 1]) / (record.times[i] - record.times[i - 1]);
    return record.displacements[i - 1] + share * (record.displacements[i] - record.displacements[i - 1]);
}

Pieces pieces_of(const FallSeries& record) {
    const TimeWindow& window = record.measures.window;
    const std::size_t first = frame_at(record, window.begin);
    const std::size_t last = frame_at(record, window.end);
    const auto part = [&](const std::vector<double>& series) {
        const auto begin = series.begin() + static_cast<std::ptrdiff_t>(first);
        return std::vector<double>(begin, series.begin() + static_cast<std::ptrdiff_t>(last + 1));
    };
    const std::vector<double> inclinations = part(record.inclinations);
    Pieces result;
    result.minima = inclination_minima(part(record.times), inclinations, required_prominence(inclinations));
    const Regime regime = record.measures.regime;
    if ((regime == Regime::steady || regime == Regime::autorotating) && result.minima.size() < 4) {
        if (last - first < steady_pieces) return result;
        std::vector<std::size_t> cuts;
        for (std::size_t i = 0; i <= steady_pieces; ++i) {
            cuts.push_back(first + i * (last - first) / steady_pieces);
        }
        result.pieces = between(cuts);
        return result;
    }
    if (result.minima.size() < 3) return result;
    std::vector<std::size_t> cuts;
    for (const double minimum : result.minima) cuts.push_back(frame_at(record, minimum));
    cuts.front() = first;
    cuts.back() = last;
    result.pieces = between(cuts);
    result.by_swings = true;
    return result;
}

std::vector<Passage> passages_of(const FallSeries& record, const std::vector<double>& depths) {
    std::vector<Passage> passages;
    double before = 0.0;
    for (std::size_t i = 1; i < record.displacements.size(); ++i) {
        const double after = record.displacements[i].dot(record.down);
        while (passages.size() < depths.size() && depths[passages.size()] <= after) {
            const double share = (depths[passages.size()] - before) / (after - before);
            const Vector3d displacement =
                record.displacements[i - 1] + share * (record.displacements[i] - record.displacements[i - 1]);
            passages.push_back({record.times[i - 1] + share * (record.times[i] - record.times[i - 1]),
                                displacement - displacement.dot(record.down) * record.down});
        }
        before = after;
    }
    return passages;
}

FirstSwing first_swing(const FallSeries& record) {
    if (record.times.size() < 3) return {};
    const double prominence = required_prominence(record.inclinations);
    std::vector<double> complements;
    for (const double angle : record.inclinations) complements.push_back(0.5 * std::numbers::pi - angle);
    const std::vector<double> minima = inclination_minima(record.times, record.inclinations, prominence);
    const std::vector<double> maxima = inclination_minima(record.times, complements, prominence);
    FirstSwing swing;
    if (!minima.empty()) swing.minimum = turning_point(record, minima.front(), true);
    if (!maxima.empty()) swing.maximum = turning_point(record, maxima.front(), false);
    return swing;
}

std::optional<double> end_of(const FirstSwing& swing) {
    if (!swing.minimum || !swing.maximum) return std::nullopt;
    return std::max(swing.minimum->time.value, swing.maximum->time.value);
}

double path_distance(const FallSeries& fall, const FallSeries& reference, double end) {
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < reference.times.size() && reference.times[i] <= end; ++i) {
        sum += (displacement_at(fall, reference.times[i]) - reference.displacements[i]).squaredNorm();
        count += 1.0;
    }
    return std::sqrt(sum / count);
}

}  // namespace samara
