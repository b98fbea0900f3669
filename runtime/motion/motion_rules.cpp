#include "samara/motion/motion_rules.hpp"

#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "samara/core/base/error.hpp"

namespace samara {
namespace {

constexpr double unit_length_tolerance = 1e-6;

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
    throw Error(fmt::format("{}: {}; simulate the scene again", file.string(), what));
}

bool is_one(double length) {
    return std::abs(length - 1.0) <= unit_length_tolerance;
}

bool is_link_name(const std::string& name) {
    return !name.empty() && name.front() != '.' && name.find('/') == std::string::npos;
}

std::string place(const std::string& body, const char* what) {
    return fmt::format("/bodies/{} {}", body, what);
}

void check_times(const std::filesystem::path& file, const std::vector<double>& times) {
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (!std::isfinite(times[i])) fail(file, fmt::format("/time row {} is not finite", i));
        if (i > 0 && times[i] <= times[i - 1]) fail(file, fmt::format("/time does not ascend at row {}", i));
    }
}

void check_body(const std::filesystem::path& file, const BodyMotion& body, int runs) {
    if (body.copies < 1) fail(file, place(body.name, "has no copy"));
    const auto all = static_cast<std::size_t>(runs) * static_cast<std::size_t>(body.copies);
    if (!body.sizes.empty() && body.sizes.size() != all) {
        fail(file, place(body.name, "has not one size for each run and copy"));
    }
    for (const double size : body.sizes) {
        if (!(size > 0.0) || !std::isfinite(size)) {
            fail(file, place(body.name, "has a size that is no positive number"));
        }
    }
    if (body.surface.corners.empty()) fail(file, place(body.name, "has a surface without triangles"));
    if (!body.center_of_mass.allFinite())
        fail(file, place(body.name, "has a centre of mass that is not finite"));
    if (!is_one(body.shortest_axis.norm()))
        fail(file, place(body.name, "has a shortest_axis that is no unit vector"));
    std::set<std::pair<std::string, std::string>> known;
    for (const MetricUncertainty& one : body.uncertainties) {
        if (!is_link_name(one.cause) || !is_link_name(one.metric) ||
            !known.emplace(one.cause, one.metric).second) {
            fail(file, place(body.name, "has an uncertainty twice or without a name"));
        }
        if (!(one.relative >= 0.0 && one.chance >= 0.0) || !std::isfinite(one.relative + one.chance)) {
            fail(file, place(body.name, "has an uncertainty that is negative or not finite"));
        }
    }
}

}  // namespace

std::string uncertainty_group(const std::string& body) {
    return "/bodies/" + body + "/uncertainty";
}

void check_motion_but_poses(const std::filesystem::path& file, const Motion& motion) {
    if (motion.times.empty()) fail(file, "/time holds no frame");
    if (motion.runs < 1) fail(file, "it holds no run");
    if (motion.bodies.empty()) fail(file, "it holds no body");
    if (!(motion.frame_rate > 0.0) || !std::isfinite(motion.frame_rate)) {
        fail(file, "frame_rate is not a positive number");
    }
    if (!motion.gravity.allFinite()) fail(file, "/gravity holds a value that is not finite");
    if (motion.ground && !std::isfinite(*motion.ground)) fail(file, "ground is not finite");
    check_times(file, motion.times);
    std::set<std::string> names;
    for (const BodyMotion& body : motion.bodies) {
        if (!is_link_name(body.name)) {
            fail(file,
                 fmt::format("the body's name '{}' is empty, starts with a dot or holds a slash", body.name));
        }
        if (!names.insert(body.name).second)
            fail(file, fmt::format("two bodies have the name {}", body.name));
        check_body(file, body, motion.runs);
    }
}

void check_poses(const std::filesystem::path& file, const std::string& body, const std::vector<Pose>& poses) {
    for (const Pose& pose : poses) {
        if (!pose.position.allFinite() || !pose.velocity.allFinite() || !pose.angular_velocity.allFinite()) {
            fail(file, place(body, "has a pose with a value that is not finite"));
        }
        if (!is_one(pose.orientation.norm()))
            fail(file, place(body, "has an orientation that is not of unit length"));
    }
}

void check_motion(const std::filesystem::path& file, const Motion& motion) {
    check_motion_but_poses(file, motion);
    const std::size_t rows = static_cast<std::size_t>(motion.runs) * motion.times.size();
    for (const BodyMotion& body : motion.bodies) {
        if (body.poses.size() != rows * static_cast<std::size_t>(body.copies)) {
            fail(file, place(body.name, "has not one pose for each run, frame and copy"));
        }
        check_poses(file, body.name, body.poses);
    }
}

}  // namespace samara
