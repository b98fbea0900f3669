#include "samara/motion/measures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/base/linear_algebra.hpp"
#include "samara/core/base/numbers.hpp"
#include "samara/motion/inclination.hpp"

namespace samara {
namespace {

constexpr double spinning_share = 0.5;  // of the mean square angular speed
constexpr double fewest_revolutions = 2.0;
constexpr double spun_up_share = 0.8;
// Ends whose distances from the centre of mass differ by less than this, over the body's spread, are alike.
constexpr double alike_ends = 0.05;

/// Returns the mean over time of a function of the frames [begin, end), by the trapezoidal rule.
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

/// Returns the direction from the centre of mass to the end of the longest axis that is farther from it: a
/// unit vector in shape axes; nothing where both ends are about as far.
std::optional<Vector3d> outward_axis(const BodyMotion& body) {
    const SurfaceSpread spread = surface_spread(body.surface);
    const PrincipalValues extents = principal_values(spread.covariance);
    const Vector3d axis = extents.directions.col(2);
    const double arm = (spread.centroid - body.center_of_mass).dot(axis);
    if (std::abs(arm) <= alike_ends * std::sqrt(extents.values[2])) return std::nullopt;
    return arm > 0.0 ? axis : Vector3d(-axis);
}

/// Returns the rotation of a body about the vertical over the frames [begin, end) of a motion; nothing where
/// it does not autorotate or makes less than two revolutions: see measure(). Turnovers are not considered.
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
    const double revolutions = std::abs(spin) * (time(end - 1) - time(begin)) / (2.0 * std::numbers::pi);
    if (revolutions < fewest_revolutions || spin * spin <= spinning_share * square) return std::nullopt;

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

constexpr double rest_share = 1e-6;
constexpr double touching = 1e-3;
constexpr double steady_range = 5.0 * degree;
constexpr double horizontal_band = 10.0 * degree;
constexpr double exception_share = 0.1;

/// The poses of one copy in one run, frames [begin, end).
struct Track {
    const Motion& motion;
    const BodyMotion& body;
    int run;
    int copy;
    int begin;
    int end;

    [[nodiscard]] const Pose& pose(int frame) const { return motion.pose(body, run, frame, copy); }
    [[nodiscard]] double time(int frame) const { return motion.times[static_cast<std::size_t>(frame)]; }
    [[nodiscard]] Vector3d axis(int frame) const { return pose(frame).orientation * body.shortest_axis; }
};

Track track_in(const Motion& motion, const BodyMotion& body, int run, int copy, const TimeWindow& window) {
    const auto& times = motion.times;
    const double slack = 1e-9 * std::max(1.0, std::abs(window.end));
    if (!(window.begin <= window.end) || window.end < times.front() - slack ||
        window.begin > times.back() + slack) {
        throw Error(fmt::format(
            "the window from {} s to {} s is outside the motion from {} s to {} s; give another window",
            window.begin, window.end, times.front(), times.back()));
    }
    auto first = std::lower_bound(times.begin(), times.end(), window.begin - slack);
    auto last = std::upper_bound(first, times.end(), window.end + slack);
    if (first == last) {
        const double middle = 0.5 * (window.begin + window.end);
        if (first == times.end() || (first != times.begin() && middle - *(first - 1) < *first - middle)) {
            --first;
        }
        last = first + 1;
    }
    return {motion,
            body,
            run,
            copy,
            static_cast<int>(first - times.begin()),
            static_cast<int>(last - times.begin())};
}

/// Returns the mean over time of a function of the frame, by the trapezoidal rule.
template <typename Function>
double time_mean(const Track& track, const Function& function) {
    if (track.end - track.begin < 2) return function(track.begin);
    double sum = 0.0;
    for (int frame = track.begin + 1; frame < track.end; ++frame) {
        sum += 0.5 * (track.time(frame) - track.time(frame - 1)) * (function(frame - 1) + function(frame));
    }
    return sum / (track.time(track.end - 1) - track.time(track.begin));
}

struct Turnovers {
    int count = 0;
    int reversals = 0;
    std::vector<double> times;  ///< s, the frame after each
};

/// Finds half rotations of the shortest axis past the horizontal, with the band of the docstring as
/// hysteresis.
Turnovers find_turnovers(const Track& track) {
    const Vector3d down = down_direction(track.motion.gravity);
    Turnovers found;
    int side = 0;
    Vector3d rotation = Vector3d::Zero();
    Vector3d last_rotation = Vector3d::Zero();
    for (int frame = track.begin; frame < track.end; ++frame) {
        const Vector3d axis = track.axis(frame);
        const double height = axis.dot(down);
        const Vector3d& spin = track.pose(frame).angular_velocity;
        const Vector3d transverse = spin - axis * axis.dot(spin);
        const bool clear = std::abs(height) > std::sin(horizontal_band);
        const int new_side = height > 0.0 ? 1 : -1;
        rotation += transverse;
        if (!clear) continue;
        if (side != 0 && new_side != side) {
            if (found.count > 0 && rotation.dot(last_rotation) < 0.0) ++found.reversals;
            ++found.count;
            found.times.push_back(track.time(frame));
            last_rotation = rotation;
        }
        side = new_side;
        rotation = transverse;
    }
    return found;
}

/// Counts the stretches between two minima in which the axis does not turn over.
int count_plain_swings(const std::vector<double>& minima, const std::vector<double>& turnovers) {
    int plain = 0;
    for (std::size_t i = 1; i < minima.size(); ++i) {
        const bool turns_over = std::any_of(turnovers.begin(), turnovers.end(), [&](double time) {
            return time > minima[i - 1] && time <= minima[i];
        });
        if (!turns_over) ++plain;
    }
    return plain;
}

Regime regime_of(const Turnovers& turnovers, int plain_swings, double inclination_range, bool autorotates) {
    const double turned_over = turnovers.count;
    const double all = turned_over + plain_swings;
    if (turned_over > 0 && turned_over >= (1.0 - exception_share) * all &&
        turnovers.reversals <= exception_share * turned_over) {
        return Regime::tumbling;
    }
    if (autorotates) return Regime::autorotating;
    if (turnovers.count == 0 && inclination_range < steady_range) return Regime::steady;
    if (turned_over <= exception_share * all) return Regime::fluttering;
    return Regime::chaotic;
}

/// Returns the height (m) above the ground of the lowest point of a body at a pose; `size`: its lengths
/// relative to its surface's.
double clearance(const BodyMotion& body, double size, double ground, const Pose& pose) {
    const Vector3d down = pose.orientation.conjugate() * -Vector3d::UnitZ();
    return pose.position.z() - ground - size * reach(body.contact_points, down);
}

/// Extrapolates a pose by `duration` (s) at its velocities.
Pose moved_on(const Pose& pose, double seconds) {
    Pose later = pose;
    later.position += seconds * pose.velocity;
    const double angle = seconds * pose.angular_velocity.norm();
    if (angle != 0.0) {
        later.orientation = Quaterniond(Eigen::AngleAxisd(angle, (seconds / angle) * pose.angular_velocity)) *
                            pose.orientation;
    }
    return later;
}

/// The first frame at which a body touches the ground, or behind a touch between two frames.
struct Touch {
    int frame;
    bool before_frame;
};

std::optional<Touch> first_touch(const Motion& motion, const BodyMotion& body, int run, int copy) {
    const double size = body.size(run, copy);
    const double radius = size * body.contact_points.bounding_radius;
    if (!motion.ground || radius == 0.0) return std::nullopt;
    const double ground = *motion.ground;
    for (int frame = 0; frame < motion.frames(); ++frame) {
        const Pose& pose = motion.pose(body, run, frame, copy);
        const double height = pose.position.z() - ground;
        if (height <= radius * (1.0 + touching) && clearance(body, size, ground, pose) <= touching * radius) {
            return Touch{frame, false};
        }
        if (frame + 1 == motion.frames()) break;
        const double interval =
            motion.times[static_cast<std::size_t>(frame) + 1] - motion.times[static_cast<std::size_t>(frame)];
        if (height + interval * pose.velocity.z() > radius) continue;
        // It fell into the ground and came out of it, so it touched it in between.
        const Pose& next = motion.pose(body, run, frame + 1, copy);
        if (clearance(body, size, ground, moved_on(pose, interval)) <= 0.0 &&
            clearance(body, size, ground, moved_on(next, -interval)) <= 0.0) {
            return Touch{frame + 1, true};
        }
    }
    return std::nullopt;
}

}  // namespace

const char* name_of(Regime regime) {
    switch (regime) {
        case Regime::fluttering:
            return "fluttering";
        case Regime::autorotating:
            return "autorotating";
        case Regime::tumbling:
            return "tumbling";
        case Regime::chaotic:
            return "chaotic";
        default:
            return "steady";
    }
}

std::optional<int> landing_frame(const Motion& motion, const BodyMotion& body, int run, int copy) {
    const std::optional<Touch> touch = first_touch(motion, body, run, copy);
    return touch ? std::optional(touch->frame) : std::nullopt;
}

TimeWindow fall_of(const Motion& motion, const BodyMotion& body, int run, int copy) {
    double fastest = 0.0;
    double fastest_spin = 0.0;
    for (int frame = 0; frame < motion.frames(); ++frame) {
        const Pose& pose = motion.pose(body, run, frame, copy);
        fastest = std::max(fastest, pose.velocity.norm());
        fastest_spin = std::max(fastest_spin, pose.angular_velocity.norm());
    }
    int first = motion.frames();
    int last = -1;
    for (int frame = 0; frame < motion.frames(); ++frame) {
        const Pose& pose = motion.pose(body, run, frame, copy);
        if (pose.velocity.norm() > rest_share * fastest ||
            pose.angular_velocity.norm() > rest_share * fastest_spin) {
            first = std::min(first, frame);
            last = frame;
        }
    }
    if (last < 0) return {motion.times.front(), motion.times.back()};
    if (const auto touch = first_touch(motion, body, run, copy); touch && touch->frame > first) {
        last = std::min(last, std::max(touch->frame - (touch->before_frame ? 2 : 1), first));
    }
    return {motion.times[static_cast<std::size_t>(std::max(first - 1, 0))],
            motion.times[static_cast<std::size_t>(std::min(last + 1, motion.frames() - 1))]};
}

TimeWindow default_window(const Motion& motion, const BodyMotion& body, int run, int copy) {
    TimeWindow window = fall_of(motion, body, run, copy);
    window.begin += (window.end - window.begin) / 3.0;
    return window;
}

Measures measure(const Motion& motion, const BodyMotion& body, int run, int copy,
                 const std::optional<TimeWindow>& window) {
    const Track track =
        track_in(motion, body, run, copy, window ? *window : default_window(motion, body, run, copy));
    const int last = track.end - 1;
    Measures measures;
    measures.window = {track.time(track.begin), track.time(last)};
    const double duration = measures.window.end - measures.window.begin;
    measures.mean_velocity =
        duration > 0.0 ? Vector3d((track.pose(last).position - track.pose(track.begin).position) / duration)
                       : track.pose(last).velocity;
    measures.descent_speed = measures.mean_velocity.dot(down_direction(motion.gravity));
    measures.rms_angular_speed = std::sqrt(
        time_mean(track, [&](int frame) { return track.pose(frame).angular_velocity.squaredNorm(); }));

    std::vector<double> times;
    std::vector<double> inclinations;
    for (int frame = track.begin; frame < track.end; ++frame) {
        times.push_back(track.time(frame));
        inclinations.push_back(inclination(motion, body, track.pose(frame)));
    }
    measures.mean_inclination = time_mean(
        track, [&](int frame) { return inclinations[static_cast<std::size_t>(frame - track.begin)]; });
    measures.inclination_amplitude = percentile(inclinations, 95.0);
    const std::vector<double> minima =
        inclination_minima(times, inclinations, required_prominence(inclinations));
    measures.swings = static_cast<int>(minima.size());
    if (minima.size() >= 2) {
        measures.frequency = 0.5 * static_cast<double>(minima.size() - 1) / (minima.back() - minima.front());
    }
    const Turnovers turnovers = find_turnovers(track);
    measures.turnovers = turnovers.count;
    if (turnovers.count == 0) {
        measures.autorotation = autorotation_of(motion, body, run, copy, track.begin, track.end);
    }
    measures.regime = regime_of(turnovers, count_plain_swings(minima, turnovers.times),
                                measures.inclination_amplitude - percentile(inclinations, 5.0),
                                measures.autorotation.has_value());
    return measures;
}

}  // namespace samara
