#include "samara/export/float_range.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

constexpr double farthest = 1e37;

double reach_of(const std::vector<Vector3d>& vectors) {
    double reach = 0.0;
    for (const Vector3d& vector : vectors) reach = std::max(reach, vector.cwiseAbs().maxCoeff());
    return reach;
}

/// Throws Error where the numbers of `what` reach too far, or are none.
void require(bool holds, const std::filesystem::path& file, const std::string& name, const char* what) {
    if (holds) return;
    throw Error(
        fmt::format("{}: {} of '{}' exceed {:g}, the range of floats in animation tools; check the units",
                    file.string(), what, name, farthest));
}

void require_body(const std::filesystem::path& file, const Motion& motion, const BodyMotion& body, int run) {
    double size = 1.0;
    for (int copy = 0; copy < body.copies; ++copy) size = std::max(size, body.size(run, copy));
    const double offset = size * body.center_of_mass.cwiseAbs().maxCoeff();
    require(size * reach_of(body.surface.vertices) <= farthest && offset <= farthest, file, body.name,
            "vertices");
    if (body.display != nullptr) {
        require(size * reach_of(body.display->positions) <= farthest, file, body.name,
                "vertices of the display mesh");
        require(reach_of(body.display->normals) <= farthest, file, body.name, "normals of the display mesh");
        for (const Eigen::Vector2d& place : body.display->texture) {
            require(place.cwiseAbs().maxCoeff() <= farthest, file, body.name, "texture coordinates");
        }
    }
    for (int frame = 0; frame < motion.frames(); ++frame) {
        for (int copy = 0; copy < body.copies; ++copy) {
            const Pose& pose = motion.pose(body, run, frame, copy);
            const double spin = pose.angular_velocity.cwiseAbs().maxCoeff();
            require(pose.position.cwiseAbs().maxCoeff() <= farthest, file, body.name, "places");
            require(pose.velocity.cwiseAbs().maxCoeff() + spin * std::max(1.0, offset) <= farthest, file,
                    body.name, "velocities");
        }
    }
}

}  // namespace

void require_float_range(const std::filesystem::path& file, const Motion& motion, int run) {
    for (const double time : motion.times) {
        require(std::abs(time) * std::max(1.0, motion.frame_rate) <= farthest, file, "motion", "times");
    }
    for (const BodyMotion& body : motion.bodies) require_body(file, motion, body, run);
    for (const Obstacle& obstacle : motion.obstacles) {
        require(reach_of(obstacle.surface.vertices) <= farthest, file, obstacle.name, "vertices");
        for (const ObstacleKey& key : obstacle.keys) {
            require(key.position.cwiseAbs().maxCoeff() <= farthest, file, obstacle.name, "places");
        }
    }
}

}  // namespace samara
