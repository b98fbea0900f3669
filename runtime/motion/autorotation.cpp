#include "samara/motion/autorotation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/motion/inclination.hpp"

namespace samara {
namespace {

constexpr double spinning_share = 0.5;  // of the mean square angular speed
constexpr double fewest_turns = 2.0;
constexpr double spun_up_share = 0.8;
// Ends whose distances from the centre of mass differ by less than this, over the body's spread, are alike.
constexpr double alike_ends = 0.05;

/// The mean over time of a function of the frames [begin, end), by the trapezoidal rule.
template <typename Function>
auto time_mean(const Motion& motion, int begin, int end, const Function& function) {
    using Value = decltype(function(begin));
    const auto time = [&](int frame) { return motion.times[static_cast<std::size_t>(frame)]; };
    Value sum = 0.0 * function(begin);
    for (int frame = begin + 1; frame < end; ++frame) {
        sum += 0.5 * (time(frame) - time(frame - 1)) * Value(function(frame - 1) + function(frame));
    }
    return Value(sum / (time(end - 1) - time(begin)));
}

/// From the centre of mass to the end of the longest axis that is farther from it: a unit vector in shape
/// axes; nothing where both ends are about as far.
std::optional<Vector3d> outward_axis(const BodyMotion& body) {
    const SurfaceSpread spread = surface_spread(body.surface);
    const PrincipalValues extents = principal_values(spread.covariance);
    const Vector3d axis = extents.directions.col(2);
    const double arm = (spread.centroid - body.center_of_mass).dot(axis);
    if (std::abs(arm) <= alike_ends * std::sqrt(extents.values[2])) return std::nullopt;
    return arm > 0.0 ? axis : Vector3d(-axis);
}

}  // namespace

std::optional<Autorotation> autorotation_of(const Motion& motion, const BodyMotion& body, int run, int copy,
                                            int begin, int end) {
    if (end - begin < 2) return std::nullopt;
    const auto pose = [&](int frame) -> const Pose& { return motion.pose(body, run, frame, copy); };
    const auto time = [&](int frame) { return motion.times[static_cast<std::size_t>(frame)]; };
    const Vector3d down = down_direction(motion.gravity);
    const double spin =
        time_mean(motion, begin, end, [&](int frame) { return pose(frame).angular_velocity.dot(down); });
    const double square =
        time_mean(motion, begin, end, [&](int frame) { return pose(frame).angular_velocity.squaredNorm(); });
    const double turns = std::abs(spin) * (time(end - 1) - time(begin)) / (2.0 * std::numbers::pi);
    if (turns < fewest_turns || spin * spin <= spinning_share * square) return std::nullopt;

    Autorotation result;
    result.spin_rate = std::abs(spin);
    const auto horizontal = [&](int frame) -> Vector3d {
        const Vector3d& velocity = pose(frame).velocity;
        return velocity - velocity.dot(down) * down;
    };
    const Vector3d drift = time_mean(motion, begin, end, horizontal);
    result.helix_radius =
        std::sqrt(time_mean(motion, begin, end,
                            [&](int frame) { return (horizontal(frame) - drift).squaredNorm(); })) /
        result.spin_rate;
    if (const auto outward = outward_axis(body)) {
        result.coning_angle = time_mean(motion, begin, end, [&](int frame) {
            return std::asin(std::clamp(-(pose(frame).orientation * *outward).dot(down), -1.0, 1.0));
        });
    }
    const double release = fall_of(motion, body, run, copy).begin;
    int first = 0;
    while (time(first) < release) ++first;
    int spun_up = first;
    const double sense = spin > 0.0 ? 1.0 : -1.0;
    while (sense * pose(spun_up).angular_velocity.dot(down) < spun_up_share * result.spin_rate) ++spun_up;
    result.spin_up_height = (pose(spun_up).position - pose(first).position).dot(down);
    return result;
}

}  // namespace samara
