#include "samara/export/loop.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

/// The frames of a period; throws Error where it has none.
int frames_of(const Motion& motion, double period) {
    const double frames = period * motion.frame_rate;
    const double whole = std::round(frames);
    if (whole < 1.0 || std::abs(frames - whole) > 1e-6 * whole) {
        throw Error(
            fmt::format("--loop {:g}: is {:g} frames at {:g} frames per second; give a whole number of "
                        "them, or another --frame-rate",
                        period, frames, motion.frame_rate));
    }
    if (whole > motion.frames() - 1) {
        throw Error(fmt::format("--loop {:g}: the motion lasts {:g} s; give less, or simulate longer", period,
                                motion.times.back() - motion.times.front()));
    }
    return static_cast<int>(whole);
}

BodyMotion looped_body(const Motion& motion, const BodyMotion& body, int run, int frames, int pieces) {
    BodyMotion result = body;
    result.copies = body.copies * pieces;
    result.poses.clear();
    result.sizes.clear();
    for (int frame = 0; frame <= frames; ++frame) {
        for (int piece = 0; piece < pieces; ++piece) {
            for (int copy = 0; copy < body.copies; ++copy) {
                result.poses.push_back(motion.pose(body, run, piece * frames + frame, copy));
            }
        }
    }
    for (int piece = 0; !body.sizes.empty() && piece < pieces; ++piece) {
        for (int copy = 0; copy < body.copies; ++copy) result.sizes.push_back(body.size(run, copy));
    }
    return result;
}

}  // namespace

Motion looped(const Motion& motion, int run, double period) {
    const auto moving = std::find_if(motion.obstacles.begin(), motion.obstacles.end(),
                                     [](const Obstacle& obstacle) { return obstacle.moves(); });
    if (moving != motion.obstacles.end()) {
        throw Error(fmt::format("--loop: the obstacle '{}' moves, and need not be at the end where it began",
                                moving->name));
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

}  // namespace samara
