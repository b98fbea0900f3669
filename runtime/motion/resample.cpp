#include "samara/motion/resample.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

/// A time between two frames: the earlier one, and the fraction of the time to the next.
struct FramePlace {
    int frame = 0;
    double fraction = 0.0;
    double duration = 0.0;
};

constexpr double same_time = 1e-9;  // of a frame

FramePlace place_of(const std::vector<double>& times, double time) {
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    FramePlace place;
    place.frame = std::max(0, static_cast<int>(after - times.begin()) - 1);
    if (after == times.end()) return place;
    const auto frame = static_cast<std::size_t>(place.frame);
    place.duration = times[frame + 1] - times[frame];
    place.fraction = std::clamp((time - times[frame]) / place.duration, 0.0, 1.0);
    if (place.fraction < same_time) place.fraction = 0.0;
    if (place.fraction > 1.0 - same_time) {
        ++place.frame;
        place.fraction = 0.0;
    }
    return place;
}

/// Returns the motion at other times (s, ascending), which are within its own.
Motion sampled_at(const Motion& motion, const std::vector<double>& times) {
    Motion result = motion;
    result.times.clear();
    std::vector<FramePlace> places;
    for (const double time : times) {
        const FramePlace place = place_of(motion.times, time);
        places.push_back(place);
        result.times.push_back(place.fraction == 0.0 ? motion.times[static_cast<std::size_t>(place.frame)]
                                                     : time);
    }
    for (std::size_t b = 0; b < motion.bodies.size(); ++b) {
        const BodyMotion& body = motion.bodies[b];
        std::vector<Pose>& poses = result.bodies[b].poses;
        poses.clear();
        result.bodies[b].forces.clear();
        poses.reserve(static_cast<std::size_t>(motion.runs) * places.size() *
                      static_cast<std::size_t>(body.copies));
        for (int run = 0; run < motion.runs; ++run) {
            for (const FramePlace& place : places) {
                for (int copy = 0; copy < body.copies; ++copy) {
                    const Pose& before = motion.pose(body, run, place.frame, copy);
                    poses.push_back(place.fraction == 0.0
                                        ? before
                                        : smoothly_interpolated(before,
                                                                motion.pose(body, run, place.frame + 1, copy),
                                                                place.fraction, place.duration));
                    if (!motion.has_forces) continue;
                    const FluidForces& forces = body.forces[motion.index(body, run, place.frame, copy)];
                    result.bodies[b].forces.push_back(
                        place.fraction == 0.0
                            ? forces
                            : forces.towards(body.forces[motion.index(body, run, place.frame + 1, copy)],
                                             place.fraction));
                }
            }
        }
    }
    return result;
}

/// Returns the frames of a period; throws Error where it has none.
int frames_of(const Motion& motion, double period) {
    const double frames = period * motion.frame_rate;
    const double whole = std::round(frames);
    if (whole < 1.0 || std::abs(frames - whole) > 1e-6 * whole) {
        throw Error(
            fmt::format("--loop {:g}: is {:g} frames at {:g} frames per second; give a whole number of "
                        "frames, or another --frame-rate",
                        period, frames, motion.frame_rate));
    }
    if (whole > motion.frames() - 1) {
        throw Error(
            fmt::format("--loop {:g}: the motion lasts {:g} s; give a shorter loop, or simulate longer",
                        period, motion.times.back() - motion.times.front()));
    }
    return static_cast<int>(whole);
}

BodyMotion looped_body(const Motion& motion, const BodyMotion& body, int run, int frames, int pieces) {
    BodyMotion result = body;
    result.copies = body.copies * pieces;
    result.poses.clear();
    result.forces.clear();
    result.sizes.clear();
    for (int frame = 0; frame <= frames; ++frame) {
        for (int piece = 0; piece < pieces; ++piece) {
            for (int copy = 0; copy < body.copies; ++copy) {
                const std::size_t index = motion.index(body, run, piece * frames + frame, copy);
                result.poses.push_back(body.poses[index]);
                if (motion.has_forces) result.forces.push_back(body.forces[index]);
            }
        }
    }
    for (int piece = 0; !body.sizes.empty() && piece < pieces; ++piece) {
        for (int copy = 0; copy < body.copies; ++copy) result.sizes.push_back(body.size(run, copy));
    }
    return result;
}

}  // namespace

Motion resampled(const Motion& motion, double frame_rate) {
    if (!(frame_rate > 0.0) || !std::isfinite(frame_rate)) {
        throw Error(fmt::format("the frame rate {} is not a positive number", frame_rate));
    }
    const double begin = motion.times.front();
    const double count = std::floor((motion.times.back() - begin) * frame_rate + same_time) + 1.0;
    if (count > std::numeric_limits<int>::max()) {
        throw Error(
            fmt::format("{} frames per second give too many frames; lower the frame rate", frame_rate));
    }
    std::vector<double> times;
    times.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < static_cast<int>(count); ++i) times.push_back(begin + i / frame_rate);
    Motion result = sampled_at(motion, times);
    result.frame_rate = frame_rate;
    return result;
}

Motion slowed(Motion motion, double factor) {
    motion.frame_rate /= factor;
    for (double& time : motion.times) time *= factor;
    for (Obstacle& obstacle : motion.obstacles) {
        for (ObstacleKey& key : obstacle.keys) key.time *= factor;
    }
    for (BodyMotion& body : motion.bodies) {
        for (Pose& pose : body.poses) {
            pose.velocity /= factor;
            pose.angular_velocity /= factor;
        }
    }
    return motion;
}

Motion still_at(const Motion& motion, double time) {
    const double frame = same_time / motion.frame_rate;
    if (!(time >= motion.times.front() - frame) || !(time <= motion.times.back() + frame)) {
        throw Error(fmt::format("--at {:g}: the motion lasts from {:g} to {:g} s; give a time in between",
                                time, motion.times.front(), motion.times.back()));
    }
    return sampled_at(motion, {std::clamp(time, motion.times.front(), motion.times.back())});
}

Motion looped(const Motion& motion, int run, double period) {
    const auto moves = std::find_if(motion.obstacles.begin(), motion.obstacles.end(),
                                    [](const Obstacle& obstacle) { return obstacle.moves(); });
    if (moves != motion.obstacles.end()) {
        throw Error(fmt::format(
            "--loop: the obstacle '{}' moves and does not repeat; leave --loop out, or keep it fixed",
            moves->name));
    }
    const int frames = frames_of(motion, period);
    const int pieces = (motion.frames() - 1) / frames;
    Motion result = motion;
    result.runs = 1;
    result.times.resize(static_cast<std::size_t>(frames) + 1);
    result.bodies.clear();
    for (const BodyMotion& body : motion.bodies) {
        result.bodies.push_back(looped_body(motion, body, run, frames, pieces));
    }
    return result;
}

FastRotation fastest_rotation(const Motion& motion, int run) {
    FastRotation fastest;
    for (const BodyMotion& body : motion.bodies) {
        for (int frame = 0; frame < motion.frames(); ++frame) {
            for (int copy = 0; copy < body.copies; ++copy) {
                const double rate = motion.pose(body, run, frame, copy).angular_velocity.norm();
                const double revolutions = rate / (2.0 * std::numbers::pi * motion.frame_rate);
                if (revolutions > fastest.revolutions) fastest = {body.name, revolutions};
            }
        }
    }
    return fastest;
}

}  // namespace samara
