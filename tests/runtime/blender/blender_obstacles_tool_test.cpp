// Obstacles, wind, masses and flights on disk of the add-on in real Blender (tests/tools/use_addon.py).

#include <algorithm>

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
using test::bodies_of;
using test::distance;
using test::expect_same_poses;
using test::pose_of;
using test::rubber_file;
using test::TemporaryFolder;
using test::use_addon;
using testing::Each;
using testing::HasSubstr;

/// Triangles, corner by corner, as an .obj file.
std::string obj_of(const json& triangles) {
    std::string text;
    for (const json& triangle : triangles) {
        for (const json& corner : triangle) {
            text += fmt::format("v {} {} {}\n", corner[0].get<double>(), corner[1].get<double>(),
                                corner[2].get<double>());
        }
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        text += fmt::format("f {} {} {}\n", 3 * i + 1, 3 * i + 2, 3 * i + 3);
    }
    return text;
}

/// The scene of `samara simulate` that is the task roof.
std::string roof_scene(const json& starts, const std::string& body_file) {
    return "[scene]\nduration = 2.51\nframe_rate = 23.976023976023978\nseed = 5\nground = -0.8\n"
           "[wind]\nvelocity = [0, 0.05, 0]\n"
           "profile = { law = \"log\", height = 2, roughness = 0.05 }\n"
           "gusts = { rms = 0.02, length = 0.3, seed = 4 }\n"
           "[[obstacle]]\nname = \"Roof\"\nshape = \"roof.obj\"\nfriction = 0.3\n" +
           bodies_of(starts, body_file);
}

TEST(BlenderObstacles, AreMetInTheWindAsInSamaraSimulate) {
    const TemporaryFolder folder;
    const std::string file = rubber_file(folder);
    const json found = use_addon({"roof", file});
    EXPECT_EQ(found["error"], "");
    (void)folder.file("roof.obj", obj_of(found["triangles"]));
    (void)folder.file("scene.toml", roof_scene(found["starts"], file));
    const auto run = run_program_in(folder, {"samara", "simulate", "scene.toml", "-o", "motion.h5"});
    ASSERT_EQ(run.status, 0) << run.error;
    const Motion motion = read_motion_file(folder / "motion.h5");
    for (const auto& item : found["starts"].items()) {
        const std::string& name = item.key();
        const json& start = item.value();
        const auto body =
            std::find_if(motion.bodies.begin(), motion.bodies.end(),
                         [&](const BodyMotion& one) { return one.name == start["noise_name"]; });
        ASSERT_NE(body, motion.bodies.end());
        const auto poses = shape_poses(motion, *body, 0, 0);
        for (std::size_t frame = 0; frame < 61; ++frame) {
            const double error = distance(pose_of(found["matrices"][name][frame]), poses[frame]);
            EXPECT_LT(error, 1e-3) << name << ", frame " << frame << ": its vertices are of single precision";
        }
    }
}

TEST(BlenderObstacles, AreMetLiveAsByTheKeysAndFollowedWhereTheyAreMovedOrUnticked) {
    const TemporaryFolder folder;
    const json found = use_addon({"roof", rubber_file(folder)});
    EXPECT_EQ(found["live_error"], "");
    EXPECT_THAT(found["live_errors"].get<std::vector<std::string>>(), Each(""));
    for (const auto& [name, matrices] : found["matrices"].items()) {
        const auto last = pose_of(matrices.back());
        // Where single precision holds the start as it is, the last bit; else the hit makes 5e-5 of 6e-8.
        const double largest_angle = name == "rubber" ? 1e-12 : 1e-4;
        expect_same_poses(found["live"][name], matrices, largest_angle);
        expect_same_poses(found["roof_back"][name], matrices, largest_angle);
        EXPECT_GT(distance(pose_of(found["roof_far"][name][0]), last), 0.1);
        EXPECT_GT(distance(pose_of(found["no_roof"][name][0]), last), 0.1);
    }
}

TEST(BlenderObstacles, ThatKeysMoveLiftBodies) {
    const TemporaryFolder folder;
    const json found = use_addon({"lift", rubber_file(folder)});
    EXPECT_EQ(found["error"], "");
    EXPECT_EQ(found["live_error"], "");
    EXPECT_EQ(found["frame"], 11) << "the scene's frame stays";
    for (const auto& [name, matrices] : found["matrices"].items()) {
        // Its top is at -0.15 m, 0.05 m and 0.25 m; the bodies reach from 1 to 4 cm.
        for (std::size_t i = 1; i < 3; ++i) {
            const double height = pose_of(matrices[i]).position.z();
            const double top = i == 1 ? 0.05 : 0.25;
            EXPECT_GT(height, top + 0.0095) << name;
            EXPECT_LT(height, top + 0.05) << name;
        }
        expect_same_poses(found["live"][name], matrices);
    }
}

TEST(BlenderObstacles, ThatCannotBeAreNamed) {
    const TemporaryFolder folder;
    const json found = use_addon({"lift", rubber_file(folder)});
    const auto error = [&](const char* name) { return found[name].get<std::string>(); };
    EXPECT_THAT(error("scale"), HasSubstr("Cube: its scale is animated"));
    EXPECT_THAT(error("inside"), HasSubstr("starts inside obstacle 'Cube'"));
    EXPECT_THAT(error("no_faces"), HasSubstr("Cube: has no faces"));
    EXPECT_THAT(error("is_obstacle"), HasSubstr("rubber: is an obstacle"));
}

TEST(BlenderMass, IsTheFilesOrTheDensityOrGivenWithCentreAndInertia) {
    const TemporaryFolder folder;
    Body body = test::rubber();
    body.mass.emplace().density = 1200.0;
    const auto file = folder / "rubber.body.h5";
    write_body_file(file, body);
    const json found = use_addon({"masses", file.string()});
    EXPECT_EQ(found["source"], "FILE") << "the default";
    const auto pose = [&](const char* name) { return pose_of(found[name]); };
    EXPECT_LT(distance(pose("file"), pose("same_density")), 1e-6);
    EXPECT_LT(distance(pose("file"), pose("same_mass")), 1e-4) << "its mass is of single precision";
    EXPECT_GT(distance(pose("file"), pose("density")), 0.01);
    EXPECT_GT(distance(pose("file"), pose("off_center")), 1e-3);
    EXPECT_GT(distance(pose("off_center"), pose("inertia")), 1e-3);
    EXPECT_THAT(found["no_inertia"].get<std::string>(), HasSubstr("moments of inertia"));
}

TEST(BlenderAddon, FliesObjectsAtTheirScaleAndReleasesThemOneByOne) {
    const TemporaryFolder folder;
    const std::string file = rubber_file(folder);
    const json found = use_addon({"sizes", file});
    EXPECT_EQ(found["error"], "");
    double smallest = 2.0;
    double largest = 0.5;
    int late = 0;
    for (std::size_t i = 0; i < found["scales"].size(); ++i) {
        const double scale = found["scales"][i][0].get<double>();
        EXPECT_EQ(found["scales"][i], json::array({scale, scale, scale}));
        smallest = std::min(smallest, scale);
        largest = std::max(largest, scale);
        const json& heights = found["places"][i];
        const bool waits = found["releases"][i].get<double>() > 3.0;
        late += waits ? 1 : 0;
        EXPECT_EQ(heights[0] == heights[1], waits) << i << ": at the first frame and three later";
        EXPECT_LT(heights[2], heights[0]);
    }
    EXPECT_GE(smallest, 0.5);
    EXPECT_LE(largest, 2.0);
    EXPECT_GT(largest / smallest, 1.5);
    EXPECT_GT(late, 2);
    EXPECT_LT(late, 12);

    BodyPhysics physics;
    physics.mass.mass = 1200.0 * 33.51032163829e-6;
    physics.mass.center_of_mass = Vector3d(0.0, 0.0, 0.004);
    physics.loads = Loads::table;
    physics.turbulence = Turbulence::none;
    const json& start = found["start"];
    const auto place = [](const json& rows) {
        return Vector3d(rows[0][3].get<double>(), rows[1][3].get<double>(), rows[2][3].get<double>());
    };
    Simulation simulation;
    simulation.add({test::rubber(), ""}, physics,
                   {.position = place(start),
                    .orientation = Quaterniond(0.8, 0.0, 0.6, 0.0),
                    .start = 0.2,
                    .smallest_size = 2.0,
                    .largest_size = 2.0});
    simulation.advance_to(1.0);
    const Vector3d origin = shape_origin(simulation.pose(0), simulation.center_of_mass(0));
    EXPECT_LT((place(found["twice"]) - origin).norm(), 1e-4) << "its mass is of single precision";
    EXPECT_GT((origin - place(start)).norm(), 0.05);
}

TEST(BlenderAddon, AppliesDeltaTransformsOnce) {
    const TemporaryFolder folder;
    const json found = use_addon({"deltas", rubber_file(folder)});
    for (const json& error : found["errors"]) EXPECT_EQ(error, "");
    const json& own = found["own"];
    EXPECT_GT(distance(pose_of(own["keyed"][2]), pose_of(own["begin"])), 0.01) << "it falls";
    for (const char* name : {"own", "euler", "quaternion"}) {
        const json& body = found[name];
        expect_same_poses(body["keyed"], own["keyed"]);
        expect_same_poses(body["live"], own["keyed"]);
        expect_same_poses(json::array({body["begin"], body["end"]}),
                          json::array({own["begin"], own["begin"]}));
    }
    EXPECT_THAT(found["animated"].get<std::string>(), HasSubstr("its delta transform has keys"));
}

TEST(BlenderLive, EndsFlightsThatNoObjectShowsAnyMore) {
    const TemporaryFolder folder;
    const json found = use_addon({"ended", rubber_file(folder)});
    EXPECT_EQ(found["off"], 0);
    EXPECT_EQ(found["removed"], 1) << "the one that stays";
}

TEST(BlenderAddon, LetsGoOfAnObjectWhereItsKeysHaveItWithTheirVelocity) {
    const TemporaryFolder folder;
    const json found = use_addon({"led", rubber_file(folder)});
    EXPECT_EQ(found["error"], "");
    const double frame = found["seconds_per_frame"].get<double>();
    for (std::size_t i = 0; i < found["led"].size(); ++i) {
        expect_same_poses(json::array({found["flown"][i]}), json::array({found["led"][i]}));
    }
    BodyPhysics physics;
    physics.mass.density = 1200.0;
    physics.loads = Loads::table;
    physics.turbulence = Turbulence::none;
    // Two units of 0.1 m and half as many upwards, and a radian, in 20 frames; let go after 10.
    const double share = 0.5;
    Release release{.position = share * Vector3d(0.2, 0.0, 0.1),
                    .orientation = Quaterniond(Eigen::AngleAxisd(share, Vector3d::UnitY())),
                    .angular_velocity = Vector3d(0.0, 1.0, 0.0) / (20.0 * frame),
                    .start = 10.0 * frame};
    const Vector3d of_origin = Vector3d(0.2, 0.0, 0.1) / (20.0 * frame);
    Simulation asked;
    asked.add({test::rubber(), ""}, physics, release);
    release.velocity =
        of_origin + release.angular_velocity.cross(release.orientation * asked.center_of_mass(0));
    Simulation simulation;
    simulation.add({test::rubber(), ""}, physics, release);
    for (int i = 10; i <= 30; ++i) {
        simulation.advance_to(i * frame);
        const Pose pose = simulation.pose(0);
        const ShapePose keyed = pose_of(found["flown"][static_cast<std::size_t>(i)]);
        EXPECT_LT((keyed.position - shape_origin(pose, simulation.center_of_mass(0))).norm(), 2e-5) << i;
        EXPECT_LT(keyed.orientation.angularDistance(pose.orientation), 1e-3) << i;
    }
    EXPECT_EQ(found["again"], "") << "keys that samara made lead as well";
    for (std::size_t i = 0; i < 31; ++i) {
        const ShapePose once = pose_of(found["flown"][i]);
        const ShapePose again = pose_of(found["flown_again"][i]);
        EXPECT_LT(distance(once, again), 1e-4) << i;
    }
}

TEST(BlenderAddon, GivesAnObjectBackToItsKeysEvenly) {
    const TemporaryFolder folder;
    const json found = use_addon({"returned", rubber_file(folder)});
    EXPECT_EQ(found["error"], "");
    const auto pose = [&](const char* name, std::size_t frame) { return pose_of(found[name][frame]); };
    // Counted from 0: released at 4, back at 24, over 10 frames.
    for (std::size_t i = 0; i <= 14; ++i)
        EXPECT_LT(distance(pose("returned", i), pose("flown", i)), 1e-5) << i;
    for (std::size_t i = 24; i <= 40; ++i) {
        EXPECT_LT(distance(pose("returned", i), pose("keyed", i)), 1e-5) << i;
        EXPECT_LT(angle(pose("returned", i), pose("keyed", i)), 2e-3) << i;
    }
    EXPECT_GT(distance(pose("flown", 24), pose("keyed", 24)), 0.1);
    // The blend takes no longer way from frame to frame than it must, and begins and ends with either's own.
    const auto way = [&](const char* name, std::size_t frame) {
        return Vector3d(pose(name, frame + 1).position - pose(name, frame).position);
    };
    const double apart = distance(pose("flown", 19), pose("keyed", 19));
    for (std::size_t i = 14; i < 24; ++i) EXPECT_LT(way("returned", i).norm(), 0.05 + 0.4 * apart) << i;
    EXPECT_LT((way("returned", 14) - way("flown", 14)).norm(), 0.06 * apart);
    EXPECT_LT((way("returned", 23) - way("keyed", 24)).norm(), 0.06 * apart);
    for (std::size_t i = 0; i <= 40; ++i) {
        EXPECT_LT(distance(pose("again", i), pose("returned", i)), 1e-4) << i;
    }
    EXPECT_THAT(found["jump"].get<std::string>(), HasSubstr("its keys move at"));
    EXPECT_THAT(found["too_early"].get<std::string>(), HasSubstr("returns to its keys before its release"));
    EXPECT_THAT(found["no_keys"].get<std::string>(), HasSubstr("has Return set, but no keys"));
}

TEST(BlenderAddon, LetsBodiesMeetWhereTheSceneSaysSo) {
    const TemporaryFolder folder;
    const json found = use_addon({"meeting", rubber_file(folder)});
    const auto height = [&](const char* name, std::size_t body) {
        return pose_of(found[name][body][2]).position.z();
    };
    // On the same spot of the ground, or one beside or on the other.
    EXPECT_LT(distance(pose_of(found["alone"][0][2]), pose_of(found["alone"][1][2])), 1e-3);
    EXPECT_GT(distance(pose_of(found["met"][0][2]), pose_of(found["met"][1][2])), 0.018);
    EXPECT_NEAR(height("alone", 0), height("met", 0), 0.01);
    for (const char* name : {"alone", "met"}) {
        for (std::size_t body = 0; body < 2; ++body) {
            expect_same_poses(found[name][body], found[std::string(name) + "_live"][body]);
        }
    }
}

TEST(BlenderLive, ReadsFlightsFromTheDiskAndFliesThoseAnewThatAreDamaged) {
    const TemporaryFolder folder;
    const json found = use_addon({"cache", rubber_file(folder), folder.path().string()});
    EXPECT_EQ(found["files"], 3);
    EXPECT_EQ(found["flown_again"], 0);
    EXPECT_EQ(found["flown_damaged"], 3);
    for (const auto& [name, matrices] : found["first"].items()) {
        expect_same_poses(found["again"][name], matrices);
        expect_same_poses(found["damaged"][name], matrices);
    }
}

TEST(BlenderLive, DoesNotWaitForASlowFlightAndShowsItAsItGoesOn) {
    const TemporaryFolder folder;
    const json found = test::use_addon_in_window({"live_in_window", rubber_file(folder)});
    EXPECT_EQ(found["error"], "");
    EXPECT_LT(found["flown"], 61) << "the frame was not there yet";
    EXPECT_LT(found["moved_on"], 61) << "they moved before all was there";
    EXPECT_EQ(found["frame"], 71);
    for (const auto& [name, keyed] : found["keyed"].items()) {
        expect_same_poses(json::array({found["shown"][name]}), json::array({keyed}));
    }
}

}  // namespace
}  // namespace samara
