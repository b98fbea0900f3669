#include "samara/analysis/metrics/fall_series.hpp"

#include <algorithm>

#include "samara/motion/inclination.hpp"

namespace samara {
namespace {

constexpr std::size_t steady_pieces = 8;

/// The first frame at or after a time.
std::size_t frame_at(const FallSeries& record, double time) {
    const double slack = 1e-9 * std::max(1.0, record.duration());
    const auto place = std::lower_bound(record.times.begin(), record.times.end(), time - slack);
    return std::min(static_cast<std::size_t>(place - record.times.begin()), record.times.size() - 1);
}

/// Stretches between the frames, each of which ends where the next begins.
std::vector<Piece> between(const std::vector<std::size_t>& cuts) {
    std::vector<Piece> pieces;
    for (std::size_t i = 1; i < cuts.size(); ++i) {
        if (cuts[i] > cuts[i - 1]) pieces.push_back({cuts[i - 1], cuts[i] + 1});
    }
    return pieces;
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

}  // namespace samara
