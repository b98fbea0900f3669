#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "c_interface_calls.hpp"
#include "samara/export/shape_pose.hpp"

// What tasks of tests/tools/use_addon.py find: matrices in the world.

namespace samara::test {

inline constexpr double unit = 0.1;  ///< metres, of the tasks' scenes

inline std::string rubber_file(const TemporaryFolder& folder) {
    const auto file = folder / "rubber.body.h5";
    write_body_file(file, test::rubber());
    return file.string();
}

/// The bodies of a scene file that start as a task's do.
inline std::string bodies_of(const nlohmann::json& starts, const std::string& body_file) {
    std::string text;
    for (const auto& [name, start] : starts.items()) {
        text +=
            fmt::format("[[body]]\nname = {}\nshape = \"{}\"\ndensity = 1600\nturbulence = \"{}\"\n",
                        start["noise_name"].dump(), body_file, start["noise"].get<bool>() ? "table" : "none");
        for (const char* key : {"position", "orientation", "velocity", "angular_velocity"}) {
            text += fmt::format("{} = {}\n", key, start[key].dump());
        }
    }
    return text;
}

inline ShapePose pose_of(const nlohmann::json& rows) {
    Matrix3d turn;
    ShapePose pose;
    for (std::size_t row = 0; row < 3; ++row) {
        const auto i = static_cast<Eigen::Index>(row);
        const auto values = rows[row].get<std::vector<double>>();
        turn.row(i) = Eigen::Map<const Eigen::RowVector3d>(values.data());
        pose.position[i] = unit * values[3];
    }
    pose.orientation = Quaterniond(turn).normalized();
    return pose;
}

inline double distance(const ShapePose& a, const ShapePose& b) {
    return (a.position - b.position).norm();
}

/// rad
inline double angle(const ShapePose& a, const ShapePose& b) {
    return 2.0 * std::asin(std::min(1.0, (a.orientation.conjugate() * b.orientation).vec().norm()));
}

/// `largest_angle`: rad. Keys are of single precision, 6e-8: a long fall makes more of that.
inline void expect_same_poses(const nlohmann::json& is, const nlohmann::json& shall,
                              double largest_angle = 1e-5) {
    ASSERT_EQ(is.size(), shall.size());
    for (std::size_t i = 0; i < is.size(); ++i) {
        EXPECT_LT(distance(pose_of(is[i]), pose_of(shall[i])), 1e-6) << "pose " << i;
        EXPECT_LT(angle(pose_of(is[i]), pose_of(shall[i])), largest_angle) << "pose " << i;
    }
}

}  // namespace samara::test
