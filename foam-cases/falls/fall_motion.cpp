#include "foam-cases/falls/fall_motion.hpp"

#include <vector>

#include <fmt/format.h>

#include "internal/flight/world_pose.hpp"
#include "samara/base/error.hpp"

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

}  // namespace

void take_fall(const FallRecord& record, const BodyState& start, double start_time,
               const Surroundings& surroundings, Motion& motion) {
    const std::vector<TimedPose> steps = flow_poses(record, start);
    const double half_step = 0.5 * record.fall.time_step * record.fall.time_unit();
    BodyMotion& body = motion.bodies.front();
    std::size_t frame = 0;
    std::size_t after = 1;
    for (; frame < motion.times.size(); ++frame) {
        const double time = motion.times[frame] - start_time;
        if (time < 0.0) {
            body.poses.push_back(held(flow_pose(start), surroundings, start_time));
            continue;
        }
        if (time > steps.back().time + half_step) break;
        while (after + 1 < steps.size() && steps[after].time < time) ++after;
        const TimedPose& from = steps[after - 1];
        const TimedPose& to = steps[after];
        const Pose pose = pose_between(from.pose, to.pose, from.time, to.time - from.time, time);
        body.poses.push_back(in_world(pose, surroundings, motion.times[frame]));
    }
    if (frame < 2) throw Error(fmt::format("{}: the fall ends before its second frame", record.fall.name));
    motion.times.resize(frame);
}

}  // namespace samara
