// Bodies that the add-on adds, those that spin, and keyed winds, in real Blender (tests/tools/use_addon.py).

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "blender/blender_poses.hpp"
#include "paths.hpp"
#include "samara/core/simulation/simulation.hpp"
#include "samara/motion/motion_file.hpp"
#include "support/blender_addon.hpp"
#include "support/program_run.hpp"

namespace samara {
namespace {

using nlohmann::json;
using test::angle;
using test::distance;
using test::expect_same_poses;
using test::rubber_file;
using test::TemporaryFolder;
using test::use_addon;
using testing::AllOf;
using testing::HasSubstr;

/// What a task's rows say where a Blender unit is a metre.
ShapePose pose_in_metres(const json& rows) {
    ShapePose pose = test::pose_of(rows);
    pose.position /= test::unit;
    return pose;
}

TEST(BlenderBodies, AreReadyBakedAndBringTheirFluidToAnEmptyScene) {
    const json found = use_addon({"ready"});
    EXPECT_EQ(found["file"], "samara:leaf");
    EXPECT_EQ(found["density"], 600.0);
    EXPECT_EQ(found["first_fluid"], "AIR");
    EXPECT_EQ(found["fluid_beside_the_leaf"], "AIR");
    EXPECT_EQ(found["fluid_of_the_disc"], "WATER");
    EXPECT_EQ(found["fluid_by_the_property"], "AIR");
    EXPECT_EQ(found["simulate"], "");
    EXPECT_THAT(found["unknown"].get<std::string>(),
                AllOf(HasSubstr("no ready-baked body 'sheat'"), HasSubstr("samara, sheet, sphere")));
}

TEST(BlenderBodies, AreSmoothUpToTheirEdgesAndHaveTextureCoordinates) {
    const json found = use_addon({"ready"});
    EXPECT_EQ(found["smooth"], true);
    EXPECT_LT(found["leaning"].get<double>(), 0.05) << "no normal leans over a disc's edge";
    for (std::size_t axis = 0; axis < 2; ++axis) EXPECT_NEAR(found["uv"][0][axis].get<double>(), 0.0, 1e-6);
    EXPECT_NEAR(found["uv"][1][0].get<double>(), 1.0, 1e-6);
    EXPECT_NEAR(found["uv"][1][1].get<double>(), 0.5, 0.05) << "6 by 3 cm";
}

TEST(BlenderBodies, StartAllOverAMeshInColoursBetweenTwo) {
    const json found = use_addon({"coloured"});
    ASSERT_EQ(found["on_plane"].size(), 200U);
    Vector3d mean = Vector3d::Zero();
    double farthest = 0.0;
    for (const json& row : found["on_plane"]) {
        const Vector3d place(row[0].get<double>(), row[1].get<double>(), row[2].get<double>());
        EXPECT_LE(place.cwiseAbs().head<2>().maxCoeff(), 1.0);
        EXPECT_NEAR(place.z(), 0.25, 1e-5) << "the offset";
        farthest = std::max(farthest, place.head<2>().cwiseAbs().minCoeff());
        mean += place / 200.0;
    }
    EXPECT_GT(farthest, 0.8) << "corners as well";
    EXPECT_LT(mean.head<2>().norm(), 0.15);
    double least = 1.0;
    double most = 0.0;
    for (const json& row : found["shares"]) {
        const double share = row[0].get<double>();
        for (const json& other : row) EXPECT_NEAR(other.get<double>(), share, 1e-5);
        least = std::min(least, share);
        most = std::max(most, share);
    }
    EXPECT_LT(least, 0.05);
    EXPECT_GT(most, 0.95);
    EXPECT_THAT(found["missing"].get<std::string>(), HasSubstr("Crwn: is not in the scene"));
    EXPECT_THAT(found["no_faces"].get<std::string>(), HasSubstr("has no mesh"));
}

/// The scene of the task spin, with the models that the body file recommends, at 24 frames for each of its.
std::string spin_scene(const json& starts) {
    std::string text = "[scene]\nduration = 2.51\nframe_rate = 576\nseed = 1\n[fluid]\npreset = \"air\"\n";
    for (const json& start : starts) {
        text +=
            fmt::format("[[body]]\nname = {}\nshape = \"samara:samara\"\nposition = {}\norientation = {}\n",
                        start["name"].dump(), start["position"].dump(), start["orientation"].dump());
        if (start["patches"] != 0) text += fmt::format("patches = {}\n", start["patches"].dump());
    }
    return text;
}

TEST(BlenderBodies, ThatSpinHaveKeysBetweenFramesAndFallAsTheirFileRecommends) {
    const TemporaryFolder folder;
    const json found = use_addon({"spin"});
    EXPECT_EQ(found["error"], "");
    (void)folder.file("scene.toml", spin_scene(found["starts"]));
    const auto run = run_program_in(folder, {"samara", "simulate", "scene.toml", "-o", "motion.h5"});
    ASSERT_EQ(run.status, 0) << run.error;
    const Motion motion = read_motion_file(folder / "motion.h5");
    std::size_t between = 0;
    std::size_t spinning = 0;
    for (const auto& [name, start] : found["starts"].items()) {
        const auto body = std::find_if(motion.bodies.begin(), motion.bodies.end(),
                                       [&](const BodyMotion& one) { return one.name == start["name"]; });
        ASSERT_NE(body, motion.bodies.end());
        const auto poses = shape_poses(motion, *body, 0, 0);
        const auto frames = found["frames"][name].get<std::vector<double>>();
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const ShapePose keyed = pose_in_metres(found["matrices"][name][i]);
            const ShapePose& shall = poses[static_cast<std::size_t>(std::lround((frames[i] - 1.0) * 24.0))];
            EXPECT_LT(distance(keyed, shall), 1e-4) << name << ", frame " << frames[i];
            EXPECT_LT(angle(keyed, shall), 2e-3) << name << ", frame " << frames[i];
            if (i == 0) continue;
            EXPECT_LT(angle(keyed, pose_in_metres(found["matrices"][name][i - 1])), 0.53 * std::numbers::pi);
        }
        between += frames.size() - 61;
        spinning += frames.size() > 61 ? 1 : 0;
    }
    EXPECT_GT(spinning, 0U);
    EXPECT_EQ(
        found["report"],
        fmt::format("3 objects simulated over 61 frames; {} more keys between frames, for the rotations of "
                    "{} by more than 90 degrees",
                    between, spinning));
}

TEST(BlenderWind, FollowsItsKeysAlsoLive) {
    const TemporaryFolder folder;
    const json found = use_addon({"keyed_wind", rubber_file(folder)});
    EXPECT_EQ(found["error"], "");
    EXPECT_EQ(found["live_error"], "");
    BodyPhysics physics;
    physics.mass.density = 1600.0;
    physics.loads = Loads::table;
    physics.turbulence = Turbulence::none;
    Simulation simulation;
    simulation.add({test::rubber(), ""}, physics, {});
    const auto expect_pose = [&](std::size_t frame) {
        const Vector3d origin = shape_origin(simulation.pose(0), simulation.center_of_mass(0));
        EXPECT_LT((pose_in_metres(found["keyed"][frame]).position - origin).norm(), 1e-5) << frame;
    };
    expect_pose(0);
    for (std::size_t frame = 1; frame < 25; ++frame) {
        simulation.set_wind({.velocity = Vector3d(0.05 * (static_cast<double>(frame) - 0.5), 0.0, 0.0)});
        simulation.advance_to(static_cast<double>(frame) / 24.0);
        expect_pose(frame);
    }
    EXPECT_GT(simulation.pose(0).position.x(), 0.02);
    expect_same_poses(found["live"], found["keyed"]);
    EXPECT_LT(pose_in_metres(found["live_slower"]).position.x(), 0.5 * simulation.pose(0).position.x());
    EXPECT_THAT(found["gusts"].get<std::string>(), HasSubstr("by which its gusts would jump"));
    EXPECT_THAT(found["length"].get<std::string>(), HasSubstr("the Size has keys"));
    EXPECT_THAT(found["driver"].get<std::string>(), HasSubstr("the wind's Speed has a driver"));
}

}  // namespace
}  // namespace samara
