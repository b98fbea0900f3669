#include "samara/motion/resample.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

/// A time between two frames: the earlier one, and the fraction of the way to the next.
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

}  // namespace

Motion resampled(const Motion& motion, double frame_rate) {
    if (!(frame_rate > 0.0) || !std::isfinite(frame_rate)) {
        throw Error(fmt::format("the frame rate {} is not a positive number", frame_rate));
    }
    const double begin = motion.times.front();
    const double count = std::floor((motion.times.back() - begin) * frame_rate + same_time) + 1.0;
    if (count > std::numeric_limits<int>::max()) {
        throw Error(fmt::format("{} frames per second are more frames than can be counted", frame_rate));
    }
    Motion result = motion;
    result.frame_rate = frame_rate;
    result.times.clear();
    std::vector<FramePlace> places;
    for (int i = 0; i < static_cast<int>(count); ++i) {
        const FramePlace place = place_of(motion.times, begin + i / frame_rate);
        places.push_back(place);
        result.times.push_back(place.fraction == 0.0 ? motion.times[static_cast<std::size_t>(place.frame)]
                                                     : begin + i / frame_rate);
    }
    for (std::size_t b = 0; b < motion.bodies.size(); ++b) {
        const BodyMotion& body = motion.bodies[b];
        std::vector<Pose>& poses = result.bodies[b].poses;
        poses.clear();
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
                }
            }
        }
    }
    return result;
}

}  // namespace samara
