#include "samara/analysis/metrics/first_swing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "samara/motion/inclination.hpp"

namespace samara {
namespace {

/// The turning point at a time between frames. Its time lies anywhere within a frame's length, its
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
