#include "samara/export/shape_pose.hpp"

#include <fmt/format.h>

namespace samara {

std::vector<ShapePose> shape_poses(const Motion& motion, const BodyMotion& body, int run, int copy) {
    std::vector<ShapePose> poses;
    poses.reserve(motion.times.size());
    for (int frame = 0; frame < motion.frames(); ++frame) {
        const Pose& pose = motion.pose(body, run, frame, copy);
        ShapePose shape;
        shape.position = shape_origin(pose, body.size(run, copy) * body.center_of_mass);
        shape.orientation = pose.orientation.normalized();
        if (!poses.empty() && poses.back().orientation.dot(shape.orientation) < 0.0) {
            shape.orientation.coeffs() = -shape.orientation.coeffs();
        }
        shape.angular_velocity = pose.angular_velocity;
        shape.velocity = pose.velocity + pose.angular_velocity.cross(shape.position - pose.position);
        poses.push_back(shape);
    }
    return poses;
}

std::vector<ShapePose> shape_poses(const Motion& motion, const Obstacle& obstacle) {
    std::vector<ShapePose> places;
    for (const double time : motion.times) {
        const ObstaclePlace place = place_of(obstacle, time);
        places.push_back({.position = place.position, .orientation = place.orientation});
        if (places.size() > 1)
            keep_sign_continuous(places.back().orientation, places[places.size() - 2].orientation);
    }
    return places;
}

std::string copy_name(const BodyMotion& body, int copy) {
    return copy == 0 ? body.name : fmt::format("{}.{:03d}", body.name, copy);
}

}  // namespace samara
