// The add-on in real Blender, from its zip (tests/tools/use_addon.py).

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "blender/blender_poses.hpp"
#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/base/version.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/hdf5_writer.hpp"
#include "samara/core/files/replace_file.hpp"
#include "samara/export/gltf_file.hpp"
#include "samara/export/shape_pose.hpp"
#include "samara/motion/motion_file.hpp"
#include "support/blender_addon.hpp"
#include "support/program_run.hpp"
#include "synthetic_motion.hpp"

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
using test::use_addon_in_window;
using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::MatchesRegex;

/// The scene of `samara simulate` that is the one in Blender: water, seed 5, 24 over 1.001 frames a second.
std::string scene_of(const json& starts, const std::string& body_file) {
    return "[scene]\nduration = 2.51\nframe_rate = 23.976023976023978\nseed = 5\n" +
           bodies_of(starts, body_file);
}

TEST(BlenderAddon, HasTheLibrarysVersionBesideAPythonPackageNamedSamara) {
    const json found = use_addon({"version"});
    EXPECT_EQ(found["library"], version);
    EXPECT_EQ(found["bl_info"], version);
    EXPECT_THAT(found["package"].get<std::string>(), EndsWith("/python/samara/__init__.py"));
}

TEST(BlenderAddon, ExamplesFailInOneLineWhereItIsNotEnabled) {
    const TemporaryFolder folder;
    (void)folder.file("samara_addon/__init__.py", "");  // not the add-on, and before it in Python's path
    for (const std::string name : {"hundred_leaves", "roof", "roof_film", "panel_pictures"}) {
        const int status = run_subprocess(
            {"env", "PYTHONPATH=" + folder.path().string(),
             "BLENDER_USER_SCRIPTS=" + (folder / "scripts").string(), "blender", "-b", "--factory-startup",
             "--python", SAMARA_SOURCE_DIRECTORY "/docs/examples/" + name + ".py", "--", SAMARA_BLENDER_ZIP,
             "motion", "picture", "1", "2"},
            folder / "log");
        EXPECT_EQ(status, 1) << name;
        EXPECT_THAT(read_bytes(folder / "log"),
                    HasSubstr(SAMARA_BLENDER_ZIP ": the add-on is not enabled: AttributeError: module "
                                                 "'samara_addon' has no attribute 'bl_info'\n"));
    }
}

TEST(BlenderAddon, KeysThreeObjectsWithTheMotionOfSamaraSimulate) {
    const TemporaryFolder folder;
    const std::string file = rubber_file(folder);
    const json found = use_addon({"keys", file});
    EXPECT_EQ(found["error"], "");
    EXPECT_THAT(found["keys"].get<std::vector<int>>(), ElementsAre(61));
    EXPECT_THAT(found["range"].get<std::vector<double>>(), ElementsAre(11.0, 71.0));
    EXPECT_THAT(found["interpolations"].get<std::vector<std::string>>(), ElementsAre("LINEAR"));

    (void)folder.file("scene.toml", scene_of(found["starts"], file));
    const auto run = run_program_in(folder, {"samara", "simulate", "scene.toml", "-o", "motion.h5"});
    ASSERT_EQ(run.status, 0) << run.error;
    const Motion motion = read_motion_file(folder / "motion.h5");
    ASSERT_EQ(motion.bodies.size(), 3U);
    double farthest = 0.0;
    for (const auto& [name, start] : found["starts"].items()) {
        const BodyMotion* body = nullptr;
        for (const BodyMotion& one : motion.bodies) {
            if (one.name == start["noise_name"]) body = &one;
        }
        ASSERT_NE(body, nullptr) << name;
        const auto poses = shape_poses(motion, *body, 0, 0);
        const json& matrices = found["matrices"][name];
        ASSERT_GE(poses.size(), 61U);
        ASSERT_EQ(matrices.size(), 61U);
        for (std::size_t frame = 0; frame < 61; ++frame) {
            const ShapePose pose = pose_of(matrices[frame]);
            EXPECT_LT(distance(pose, poses[frame]), 1e-5) << name << ", frame " << frame;
            EXPECT_LT(angle(pose, poses[frame]), 1e-5) << name << ", frame " << frame;
            farthest = std::max(farthest, distance(pose, poses[0]));
        }
    }
    EXPECT_GT(farthest, 0.3) << "they fell";
}

TEST(BlenderAddon, KeysAgainFromTheFirstFrameAndUndoesItself) {
    const TemporaryFolder folder;
    const json found = use_addon({"keys", rubber_file(folder)});
    EXPECT_EQ(found["error_again"], "");
    EXPECT_EQ(found["frame"], 31) << "the scene's frame stays";
    for (const auto& [name, matrices] : found["matrices"].items()) {
        expect_same_poses(found["matrices_again"][name], matrices);
    }
    EXPECT_EQ(found["animated_after_undo"], 0);
}

TEST(BlenderAddon, ShowsLiveWhateverFrameIsAskedForWhatTheKeysShow) {
    const TemporaryFolder folder;
    const json found = use_addon({"live", rubber_file(folder)});
    EXPECT_EQ(found["error"], "");
    EXPECT_EQ(found["keys_while_live"], 0);
    EXPECT_EQ(found["simulate_while_live"], "");
    EXPECT_EQ(found["live_after"], 0);
    EXPECT_THAT(found["live_on_keys"].get<std::string>(), HasSubstr("clear them"));
    for (const auto& [name, scrubbed] : found["scrubbed"].items()) {
        expect_same_poses(scrubbed, found["keyed"][name]);
        EXPECT_GT(distance(pose_of(scrubbed[0]), pose_of(found["begin"][name])), 0.1);
    }
}

TEST(BlenderAddon, FliesLiveAnewWhereTheSeedChangesAndGoesBackToTheStart) {
    const TemporaryFolder folder;
    const json found = use_addon({"live", rubber_file(folder)});
    EXPECT_EQ(found["off"], "");
    for (const auto& [name, begin] : found["begin"].items()) {
        expect_same_poses(json::array({found["end"][name]}), json::array({begin}));
        const double change =
            distance(pose_of(found["scrubbed"][name][0]), pose_of(found["other_seed"][name][0]));
        if (name == "rubber.002") {
            EXPECT_EQ(change, 0.0) << "it has no noise";
        } else {
            EXPECT_GT(change, 1e-4);
        }
    }
}

TEST(BlenderAddon, ReportsWhatItCannotFly) {
    const TemporaryFolder folder;
    const std::string good = rubber_file(folder);
    write_hdf5(folder / "newer.body.h5", [](Hdf5Writer& file) {
        file.attribute("/", "format_version", std::int64_t{1000});
        file.attribute("/surface", "source", std::string_view("x"));
        file.attribute("/moments", "volume", 1.0);
    });
    const std::string bytes = read_bytes(good);
    const std::string cut = folder.file("cut.body.h5", bytes.substr(0, bytes.size() / 2)).string();
    const json found = use_addon({"errors", good, folder / "newer.body.h5", cut});
    const auto error = [&](const char* name) { return found[name].get<std::string>(); };
    EXPECT_THAT(error("none_selected"), HasSubstr("no selected object has a body file"));
    EXPECT_THAT(error("newer"), AllOf(HasSubstr("rubber: "), HasSubstr("newer version")));
    EXPECT_THAT(error("newer_live"), HasSubstr("newer version"));
    EXPECT_THAT(error("cut"), HasSubstr("cut.body.h5"));
    EXPECT_THAT(error("cut_live"), HasSubstr("cut.body.h5"));
    EXPECT_THAT(error("missing"), HasSubstr("No such file"));
    EXPECT_THAT(error("missing_live"), HasSubstr("No such file"));
    EXPECT_THAT(error("scale"), HasSubstr("but the body file is for"));
    EXPECT_THAT(error("range"), HasSubstr("is empty"));
    EXPECT_THAT(error("parent"), HasSubstr("has a parent"));
    EXPECT_THAT(error("in_handler"), HasSubstr("cut.body.h5"));
    EXPECT_EQ(found["live_after"], false);
    EXPECT_EQ(error("good"), "");
    EXPECT_THAT(error("no_library"), HasSubstr("install the add-on's zip"));
    EXPECT_EQ(error("library_again"), "");
}

TEST(BlenderAddon, SimulatesBesideTheWindowAndEscapeLeavesTheSceneAsItWas) {
    const TemporaryFolder folder;
    const json found = use_addon_in_window({"simulate_in_window", rubber_file(folder)});
    EXPECT_THAT(found["pressed"].get<std::vector<std::string>>(), ElementsAre("RUNNING_MODAL"));
    EXPECT_THAT(found["halfway"].get<std::string>(), MatchesRegex("samara is simulating: [1-9][0-9]? %"));
    EXPECT_EQ(found["cancelled"], "CANCELLED");
    EXPECT_EQ(found["unchanged"], true);
    EXPECT_EQ(found["finished"], "FINISHED");
    EXPECT_THAT(found["keys"].get<std::vector<int>>(), ElementsAre(61));
    EXPECT_THAT(found["refused"].get<std::string>(), HasSubstr("its scale is"));
}

TEST(BlenderAddon, BakesBesideTheWindowAndEscapeEndsTheProgram) {
    const TemporaryFolder folder;
    const json found =
        use_addon_in_window({"bake_in_window", SAMARA_PROGRAMS "/samara", folder.path().string()});
    EXPECT_THAT(found["pressed"].get<std::vector<std::string>>(), ElementsAre("RUNNING_MODAL"));
    EXPECT_THAT(found["halfway"].get<std::string>(), HasSubstr("case 3 of 10"));
    EXPECT_EQ(found["while_running"], "PASS_THROUGH") << "the user goes on working";
    EXPECT_EQ(found["cancelled"], "CANCELLED");
    EXPECT_EQ(found["process_lives"], false);
    EXPECT_EQ(found["file_when_cancelled"], "");
    EXPECT_EQ(found["refused"], "CANCELLED");
    EXPECT_EQ(found["finished"], "FINISHED");
    EXPECT_THAT(found["file"].get<std::string>(), HasSubstr("Sphere.body.h5"));
}

TEST(BlenderAddon, MendsTheImporterOfGlbFiles) {
    const TemporaryFolder folder;
    write_glb(folder / "motion.glb", test::motion_of(test::wander, 1.0));
    const json found = use_addon({"glb", folder / "motion.glb"});
    EXPECT_EQ(found["error"], "");
    EXPECT_EQ(found["meshes"], 1);
}

TEST(BlenderAddon, RendersAFrameOfTheMotion) {
    const TemporaryFolder folder;
    const json found = use_addon({"render", rubber_file(folder), folder / "frame.png"});
    EXPECT_GT(found["bright"], 0.005) << "bodies are in the picture";
    EXPECT_LT(found["bright"], 0.5);
}

}  // namespace
}  // namespace samara
