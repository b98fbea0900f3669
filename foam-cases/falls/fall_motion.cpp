#include "foam-cases/falls/fall_motion.hpp"

#include <vector>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"
#include "samara/core/flight/world_pose.hpp"

namespace samara {
namespace {

struct TimedPose {
    double time;  // s, since the body's start
    Pose pose;    // in the flow's frame
};

std::vector<TimedPose> flow_poses(const FallRecord& record, const BodyState& start) {
    const FreeFall& fall = record.fall;
    const Matrix3d to_flow = start.orientation.toRotationMatrix() * fall.axes;
    std::vector<TimedPose> poses = {{0.0, flow_pose(start)}};
    for (const FallSample& sample : record.samples) {
        Pose pose;
        pose.position = start.position + to_flow * (sample.position - fall.center_of_mass) * fall.length;
        pose.orientation = Quaterniond(to_flow * sample.turn * fall.axes.transpose());
        keep_sign_continuous(pose.orientation, poses.back().pose.orientation);
        pose.velocity = to_flow * sample.velocity * fall.speed;
        pose.angular_velocity = to_flow * sample.angular_velocity / fall.time_unit();
        poses.push_back({sample.time * fall.time_unit(), pose});
    }
    return poses;
}

// At the motion's times, until the fall's last step or half a step after it.
std::vector<Pose> poses_at(const std::vector<double>& times, const SolvedFall& fall,
                           const Surroundings& surroundings) {
    const std::vector<TimedPose> steps = flow_poses(fall.record, fall.start);
    const double half_step = 0.5 * fall.record.fall.time_step * fall.record.fall.time_unit();
    std::vector<Pose> poses;
    std::size_t after = 1;
    for (const double frame_time : times) {
        const double time = frame_time - fall.start_time;
        if (time < 0.0) {
            poses.push_back(held(flow_pose(fall.start), surroundings, fall.start_time));
            continue;
        }
        if (time > steps.back().time + half_step) break;
        while (after + 1 < steps.size() && steps[after].time < time) ++after;
        const TimedPose& from = steps[after - 1];
        const TimedPose& to = steps[after];
        const Pose pose = pose_between(from.pose, to.pose, from.time, to.time - from.time, time);
        poses.push_back(in_world(pose, surroundings, frame_time));
    }
    if (poses.size() < 2) {
        throw Error(fmt::format("{}: the fall ends before its second frame", fall.record.fall.name));
    }
    return poses;
}

}  // namespace

void take_falls(const std::vector<SolvedFall>& falls, const Surroundings& surroundings, Motion& motion) {
    std::vector<std::vector<Pose>> copies;
    for (const SolvedFall& fall : falls) {
        copies.push_back(poses_at(motion.times, fall, surroundings));
        motion.times.resize(copies.back().size());
    }
    for (std::size_t frame = 0; frame < motion.times.size(); ++frame) {
        for (const std::vector<Pose>& copy : copies) motion.bodies.front().poses.push_back(copy[frame]);
    }
}

}  // namespace samara
