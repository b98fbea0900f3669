#include "samara/analysis/metrics/tilt.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "samara/core/base/linear_algebra.hpp"
#include "samara/motion/inclination.hpp"

namespace samara {
namespace {

constexpr double across = 1e-6;  // square of what is left of an axis that lies across the plane
constexpr double most_between_frames = std::numbers::pi / 4.0;

/// The shortest axis at one frame, its end that points up.
struct UpperEnd {
    double time;
    double height;        // cosine of the inclination
    double height_rate;   // 1/s
    Vector3d horizontal;  // the rest of the unit vector
    Vector3d horizontal_rate;
};

std::vector<UpperEnd> upper_ends(const Motion& motion, const BodyMotion& body, int run, int copy) {
    const Vector3d up = -down_direction(motion.gravity);
    const TimeWindow fall = fall_of(motion, body, run, copy);
    std::vector<UpperEnd> ends;
    for (int frame = 0; frame < motion.frames(); ++frame) {
        const double time = motion.times[static_cast<std::size_t>(frame)];
        if (time < fall.begin || time > fall.end) continue;
        const Pose& pose = motion.pose(body, run, frame, copy);
        Vector3d axis = pose.orientation * body.shortest_axis;
        if (axis.dot(up) < 0.0) axis = -axis;
        const Vector3d rate = pose.angular_velocity.cross(axis);
        ends.push_back(
            {time, axis.dot(up), rate.dot(up), axis - axis.dot(up) * up, rate - rate.dot(up) * up});
    }
    return ends;
}

/// Returns the horizontal direction in which the ends swing most.
Vector3d main_side(const std::vector<UpperEnd>& ends) {
    Matrix3d squares = Matrix3d::Zero();
    for (const UpperEnd& end : ends) squares += end.horizontal * end.horizontal.transpose();
    Vector3d side = principal_values(squares).directions.col(2);
    Eigen::Index largest = 0;
    side.cwiseAbs().maxCoeff(&largest);
    return side[largest] < 0.0 ? Vector3d(-side) : side;  // along the world's axes, not against them
}

}  // namespace

Tilt tilt_of(const Motion& motion, const BodyMotion& body, int run, int copy) {
    const std::vector<UpperEnd> ends = upper_ends(motion, body, run, copy);
    const Vector3d side = main_side(ends);
    Tilt tilt;
    for (const UpperEnd& end : ends) {
        const double sine = end.horizontal.dot(side);
        const double sine_rate = end.horizontal_rate.dot(side);
        const double square = std::max(sine * sine + end.height * end.height, across);
        const double angle = std::atan2(sine, end.height);
        tilt.continues.push_back(!tilt.times.empty() &&
                                 std::abs(angle - tilt.angle.back()) < most_between_frames);
        tilt.times.push_back(end.time);
        tilt.angle.push_back(angle);
        tilt.rate.push_back((sine_rate * end.height - end.height_rate * sine) / square);
    }
    return tilt;
}

}  // namespace samara
