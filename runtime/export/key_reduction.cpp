#include "samara/export/key_reduction.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace samara {
namespace {

/// Returns the kept ones of `count` keys, by the error(begin, end, key) of the interpolation between two of
/// them.
template <typename ErrorAt>
std::vector<std::size_t> kept_of(std::size_t count, double tolerance, const ErrorAt& error) {
    std::vector<std::size_t> kept;
    if (!(tolerance > 0.0) || count < 3) {
        kept.resize(count);
        std::iota(kept.begin(), kept.end(), std::size_t{0});
        return kept;
    }
    kept = {0, count - 1};
    std::vector<std::pair<std::size_t, std::size_t>> stretches = {{0, count - 1}};
    while (!stretches.empty()) {
        const auto [begin, end] = stretches.back();
        stretches.pop_back();
        std::size_t worst = begin;
        double largest = tolerance;
        for (std::size_t key = begin + 1; key < end; ++key) {
            const double size = error(begin, end, key);
            if (size > largest) {
                largest = size;
                worst = key;
            }
        }
        if (worst == begin) continue;
        kept.push_back(worst);
        stretches.emplace_back(begin, worst);
        stretches.emplace_back(worst, end);
    }
    std::sort(kept.begin(), kept.end());
    return kept;
}

/// Returns the fraction (0 to 1) of the time between two keys at which a frame lies.
template <typename Value>
double fraction_of(const KeyedFrames<Value>& frames, std::size_t begin, std::size_t end, std::size_t frame) {
    const double start = frames.key_times[begin];
    return std::clamp((frames.times[frame] - start) / (frames.key_times[end] - start), 0.0, 1.0);
}

}  // namespace

KeyTolerance key_tolerance(const BodyMotion& body, const std::optional<double>& position) {
    const auto farthest_from = [&](const Vector3d& point) {
        double distance = 0.0;
        for (const Vector3d& vertex : body.surface.vertices) {
            distance = std::max(distance, (vertex - point).norm());
        }
        return distance;
    };
    KeyTolerance tolerance;
    tolerance.position = position.value_or(farthest_from(body.center_of_mass) / 500.0);
    const double reach = farthest_from(Vector3d::Zero());
    // A rotation by an angle moves a point at this reach by twice the reach times the sine of half of it.
    tolerance.angle = 2.0 * std::asin(std::min(1.0, 0.5 * tolerance.position / reach));
    return tolerance;
}

KeyTolerance key_tolerance(const Obstacle& obstacle, const std::optional<double>& position) {
    BodyMotion as_body;
    as_body.surface = obstacle.surface;
    return key_tolerance(as_body, position);
}

std::vector<std::size_t> kept_keys(const KeyedFrames<Vector3d>& frames, double tolerance) {
    return kept_of(frames.keys.size(), tolerance, [&](std::size_t begin, std::size_t end, std::size_t frame) {
        const double s = fraction_of(frames, begin, end, frame);
        return ((1.0 - s) * frames.keys[begin] + s * frames.keys[end] - frames.values[frame]).norm();
    });
}

std::vector<std::size_t> kept_keys(const KeyedFrames<Quaterniond>& frames, double tolerance) {
    return kept_of(frames.keys.size(), tolerance, [&](std::size_t begin, std::size_t end, std::size_t frame) {
        const double s = fraction_of(frames, begin, end, frame);
        const Quaterniond& first = frames.keys[begin];
        const Quaterniond& last = frames.keys[end];
        const Quaterniond by_arc = first.slerp(s, last);
        const Quaterniond by_components =
            Quaterniond((1.0 - s) * first.coeffs() + s * last.coeffs()).normalized();
        const Quaterniond& value = frames.values[frame];
        return std::max(by_arc.angularDistance(value), by_components.angularDistance(value));
    });
}

}  // namespace samara
