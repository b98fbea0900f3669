// The page that plays a motion, opened and worked in Debian's Chromium (tests/tools/look_at_page.mjs).

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/export/page_file.hpp"
#include "samara/formats/display_mesh_file.hpp"
#include "samara/motion/inclination.hpp"
#include "samara/motion/motion_file.hpp"
#include "support/painted_mesh.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using nlohmann::json;
using test::TemporaryFolder;
using testing::HasSubstr;

/// An ellipsoid that falls to a ground, and cubes beside it.
Motion ellipsoid_and_cubes(int copies) {
    Motion motion = test::motion_of(test::wander, 2.0);
    motion.ground = -0.7;
    motion.bodies[0].center_of_mass = Vector3d(0.01, 0.0, -0.005);
    BodyMotion cube = motion.bodies[0];
    cube.name = "die <!--<script></script> <b>red</b>";
    cube.surface = test::box({2.0, 2.0, 2.0}, 1);
    for (Vector3d& vertex : cube.surface.vertices) vertex *= 0.02;
    cube.copies = copies;
    cube.poses.clear();
    for (const double time : motion.times) {
        for (int copy = 0; copy < copies; ++copy) {
            Pose pose = test::wander(time + copy);
            const int row = copy / 20;
            pose.position = Vector3d(0.3 + 0.05 * (copy % 20), 0.1 * row, -0.3 * time);
            cube.poses.push_back(pose);
        }
    }
    motion.bodies.push_back(cube);
    return motion;
}

json look_at(const std::filesystem::path& page, double time, const TemporaryFolder& folder) {
    const int status = run_subprocess({"node", SAMARA_SOURCE_DIRECTORY "/tests/tools/look_at_page.mjs",
                                       SAMARA_NODE_TOOLS, page, std::to_string(time), folder / "picture.png"},
                                      folder / "found.json");
    EXPECT_EQ(status, 0) << read_bytes(folder / "found.json").substr(0, 2000);
    return json::parse(read_bytes(folder / "found.json"), nullptr, false);
}

TEST(Page, ShowsTheMotionsPosesAtTheTimeScrubbedTo) {
    ASSERT_TRUE(has_page()) << "configure with -DSAMARA_PAGE=ON";
    const TemporaryFolder folder;
    const Motion motion = ellipsoid_and_cubes(3);
    write_page(folder / "motion.html", motion, 0, "leaves", "60 frames per second");
    const json found = look_at(folder / "motion.html", 1.0, folder);
    EXPECT_EQ(found["time"], 1.0);
    for (std::size_t b = 0; b < 2; ++b) {
        const BodyMotion& body = motion.bodies[b];
        ASSERT_EQ(found["poses"][b].size(), static_cast<std::size_t>(body.copies));
        for (int copy = 0; copy < body.copies; ++copy) {
            const Pose& pose = motion.pose(body, 0, 60, copy);
            const json& drawn = found["poses"][b][static_cast<std::size_t>(copy)];
            const auto p = drawn["position"].get<std::vector<double>>();
            const auto q = drawn["orientation"].get<std::vector<double>>();
            EXPECT_LT((Vector3d(p[0], p[1], p[2]) - pose.position).norm(), 1e-6);
            EXPECT_LT(Quaterniond(q[0], q[1], q[2], q[3]).normalized().angularDistance(pose.orientation),
                      1e-6);
        }
    }
}

TEST(Page, ShowsSeriesAndAPictureWithoutErrorsOrANetwork) {
    ASSERT_TRUE(has_page()) << "configure with -DSAMARA_PAGE=ON";
    const TemporaryFolder folder;
    const Motion motion = ellipsoid_and_cubes(3);
    write_page(folder / "motion.html", motion, 0, "leaves", "60 frames per second");
    const json found = look_at(folder / "motion.html", 1.0, folder);
    EXPECT_EQ(found["faults"], json::array());
    for (const json& request : found["requests"])
        EXPECT_THAT(request.get<std::string>(), testing::StartsWith("file:"));
    EXPECT_GT(found["stage"]["count"], 50);
    EXPECT_GT(found["stage"]["other_share"], 0.02);
    for (const json& plot : found["plots"]) EXPECT_GT(plot["other_share"], 0.02);
    ASSERT_EQ(found["series"][0].size(), motion.times.size());
    const Pose& pose = motion.bodies[0].poses[30];
    EXPECT_NEAR(found["series"][0][30].get<double>(), -pose.velocity.z(), 1e-6);
    EXPECT_NEAR(found["series"][1][30].get<double>(),
                inclination(motion, motion.bodies[0], pose) / test::degree, 1e-4);
    EXPECT_NEAR(found["series"][2][30].get<double>(), pose.angular_velocity.norm(), 1e-5);
    const auto text = found["text"].get<std::string>();
    EXPECT_THAT(text, HasSubstr("leaves"));
    EXPECT_THAT(text, HasSubstr("die <!--<script></script> <b>red</b>"));
    EXPECT_THAT(text, HasSubstr("ground"));
    EXPECT_THAT(read_bytes(folder / "picture.png"), HasSubstr("PNG"));
    EXPECT_GT(found["shadow_share"], 0.0005);
    EXPECT_EQ(found["drawn_at_rest"], 0);
}

TEST(Page, FitsItsWindowAndItsReader) {
    ASSERT_TRUE(has_page()) << "configure with -DSAMARA_PAGE=ON";
    const TemporaryFolder folder;
    write_page(folder / "motion.html", ellipsoid_and_cubes(3), 0, "leaves", "");
    const json found = look_at(folder / "motion.html", 1.0, folder);
    EXPECT_EQ(found["overlaps"], json::array());
    EXPECT_EQ(found["help_by_key"], true);
    EXPECT_EQ(found["narrow"], json::parse(R"({"canvas": 600, "box": 600, "page": 600})"));
    EXPECT_EQ(found["dark"]["paper"], "rgb(20, 25, 31)");
    EXPECT_EQ(found["dark"]["fine"], 2);
    EXPECT_EQ(found["dark"]["plays"], false) << "reduced motion";
    EXPECT_EQ(found["dark"]["plays_after_a_tap"], true);
    EXPECT_EQ(found["faults"], json::array());
}

TEST(Page, DrawsACrowdInFewCallsAndFewTriangles) {
    ASSERT_TRUE(has_page()) << "configure with -DSAMARA_PAGE=ON";
    const TemporaryFolder folder;
    Motion motion = ellipsoid_and_cubes(200);
    motion.bodies[1].surface = test::ellipsoid({0.01, 0.008, 0.006}, 4);
    write_page(folder / "motion.html", motion, 0, "crowd", "");
    const json found = look_at(folder / "motion.html", 0.5, folder);
    EXPECT_LE(found["cost"]["calls"], 12);
    EXPECT_LT(found["cost"]["triangles"], 200 * motion.bodies[1].surface.corners.size() / 4);
    EXPECT_EQ(found["faults"], json::array());
}

TEST(Page, ShowsTheLookOfABodyWithItsImages) {
    ASSERT_TRUE(has_page()) << "configure with -DSAMARA_PAGE=ON";
    const TemporaryFolder folder;
    (void)folder.file("leaf.mtl", test::painted_mtl);
    (void)folder.file("leaf.png", test::painted_png());
    Motion motion = test::motion_of([](double) { return Pose{}; }, 0.1);
    motion.bodies[0].poses[0].orientation = Eigen::AngleAxisd(1.2, Vector3d::UnitX());
    motion.bodies[0].poses.assign(motion.times.size(), motion.bodies[0].poses[0]);
    write_page(folder / "plain.html", motion, 0, "plain", "");
    EXPECT_LT(look_at(folder / "plain.html", 0.0, folder)["hues"][1], 1e-4);
    motion.bodies[0].display = std::make_shared<const DisplayMesh>(
        read_display_mesh_file(folder.file("leaf.obj", test::painted_obj)));
    write_page(folder / "look.html", motion, 0, "look", "");
    const json found = look_at(folder / "look.html", 0.0, folder);
    EXPECT_EQ(found["faults"], json::array());
    EXPECT_GT(found["hues"][1], 0.01);
    EXPECT_EQ(found["images"], json::parse("[[1, 0]]"));
}

TEST(Page, ShowsTheColorsOfTheCopies) {
    ASSERT_TRUE(has_page()) << "configure with -DSAMARA_PAGE=ON";
    const TemporaryFolder folder;
    write_page(folder / "motion.html", ellipsoid_and_cubes(40), 0, "crowd", "",
               {.colors = {{0.0, 0.6, 0.0}, {0.0, 0.5, 0.02}}});
    const json found = look_at(folder / "motion.html", 1.0, folder);
    EXPECT_GT(found["hues"][1], 0.002);
    EXPECT_LT(found["hues"][2], 0.1 * found["hues"][1].get<double>());
}

TEST(Page, ShowsTheForcesOnTheSelectedBodyAsArrows) {
    ASSERT_TRUE(has_page()) << "configure with -DSAMARA_PAGE=ON";
    const TemporaryFolder folder;
    Motion motion = test::motion_of(test::wander, 2.0);
    write_page(folder / "without.html", motion, 0, "without", "");
    EXPECT_EQ(look_at(folder / "without.html", 1.0, folder)["arrows"],
              json::parse("[null, null, null, null]"));
    motion.has_forces = true;
    BodyMotion& body = motion.bodies[0];
    body.forces.resize(body.poses.size());
    for (FluidForces& forces : body.forces) {
        forces.drag.force = Vector3d(0.0, 0.0, 2.0);
        forces.lift.force = Vector3d(0.0, 1.0, 0.0);
    }
    write_page(folder / "forces.html", motion, 0, "forces", "");
    const json found = look_at(folder / "forces.html", 1.0, folder);
    const json& drag = found["arrows"][0];
    const json& lift = found["arrows"][1];
    EXPECT_NEAR(drag["direction"][2], 1.0, 1e-6);
    EXPECT_NEAR(lift["direction"][1], 1.0, 1e-6);
    EXPECT_NEAR(drag["length"].get<double>(), 2.0 * lift["length"].get<double>(), 1e-6);
    EXPECT_NEAR(drag["place"][0], found["poses"][0][0]["position"][0], 1e-6);
    EXPECT_EQ(found["arrows"][2], nullptr);
    EXPECT_EQ(found["faults"], json::array());
}

TEST(Page, FollowsABodyThatWouldBeTooSmallToSee) {
    ASSERT_TRUE(has_page()) << "configure with -DSAMARA_PAGE=ON";
    const TemporaryFolder folder;
    Motion motion = test::motion_of(test::wander, 2.0);
    for (std::size_t frame = 0; frame < motion.times.size(); ++frame)
        motion.bodies[0].poses[frame].position.z() = -20.0 * motion.times[frame];
    write_page(folder / "far.html", motion, 0, "far", "");
    EXPECT_EQ(look_at(folder / "far.html", 1.0, folder)["follows"], true);
    motion.bodies.push_back(motion.bodies[0]);
    motion.bodies[1].name = "other";
    write_page(folder / "two.html", motion, 0, "two", "");
    const json found = look_at(folder / "two.html", 1.0, folder);
    EXPECT_EQ(found["follows"], false);
    EXPECT_EQ(found["enlarged"], true);
    EXPECT_EQ(found["marked"], true);
}

TEST(Page, ObeysKeysAndClicks) {
    ASSERT_TRUE(has_page()) << "configure with -DSAMARA_PAGE=ON";
    const TemporaryFolder folder;
    Motion motion = ellipsoid_and_cubes(200);
    // Half a minute, so that it still plays when the key is pressed, however slowly the frames are drawn.
    motion.frame_rate /= 15.0;
    for (double& time : motion.times) time *= 15.0;
    write_page(folder / "motion.html", motion, 0, "crowd", "");
    const json found = look_at(folder / "motion.html", 0.5, folder);
    EXPECT_EQ(found["plays"], true);
    EXPECT_EQ(found["paused"], true) << "space";
    EXPECT_EQ(found["after_an_arrow"], motion.times[1]);
    EXPECT_EQ(found["chosen"], json::parse(R"({"body": 1, "copy": 0})"));
    EXPECT_EQ(found["picked"], json::parse(R"({"body": 0, "copy": 0})"));
    EXPECT_LT(found["followed"].get<double>(), 1e-9);
    EXPECT_EQ(found["faults"], json::array());
}

TEST(Page, OneFrameIsAStillScene) {
    ASSERT_TRUE(has_page()) << "configure with -DSAMARA_PAGE=ON";
    const TemporaryFolder folder;
    write_page(folder / "still.html", test::motion_of(test::wander, 0.0), 0, "still", "");
    const json found = look_at(folder / "still.html", 0.0, folder);
    EXPECT_EQ(found["plays"], false);
    EXPECT_EQ(found["faults"], json::array());
    EXPECT_GT(found["stage"]["other_share"], 0.02);
}

TEST(Page, EqualMotionsGiveEqualBytes) {
    ASSERT_TRUE(has_page()) << "configure with -DSAMARA_PAGE=ON";
    const TemporaryFolder folder;
    write_page(folder / "one.html", ellipsoid_and_cubes(2), 0, "title", "detail");
    write_page(folder / "other.html", ellipsoid_and_cubes(2), 0, "title", "detail");
    EXPECT_EQ(read_bytes(folder / "one.html"), read_bytes(folder / "other.html"));
}

TEST(Page, IsWrittenByTheCommand) {
    ASSERT_TRUE(has_page()) << "configure with -DSAMARA_PAGE=ON";
    const TemporaryFolder folder;
    Motion motion = ellipsoid_and_cubes(2);
    motion.bodies[1].name = "cube";
    write_motion_file(folder / "motion.h5", motion);
    ASSERT_EQ(run_subprocess({SAMARA_PROGRAMS "/samara", "export", folder / "motion.h5", "-o",
                              folder / "motion.html", "--frame-rate", "30", "--json"},
                             folder / "log"),
              0)
        << read_bytes(folder / "log");
    EXPECT_EQ(json::parse(read_bytes(folder / "log"))["copies"], 3);
    EXPECT_THAT(read_bytes(folder / "motion.html"), HasSubstr("30 frames per second"));
}

TEST(Page, RefusesWhatBrowsersCannotRead) {
    ASSERT_TRUE(has_page()) << "configure with -DSAMARA_PAGE=ON";
    const TemporaryFolder folder;
    Motion motion = test::motion_of(test::wander, 1.0);
    motion.bodies[0].copies = 200'000;  // rejected before the poses are read
    EXPECT_THROW(write_page(folder / "motion.html", motion, 0, "crowd", ""), Error);
    EXPECT_EQ(folder.file_count(), 0);
}

}  // namespace
}  // namespace samara
