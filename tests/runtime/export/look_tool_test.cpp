// Looks in readers that know nothing of samara: the Khronos validator, TinyUSDZ and three.js, Blender.

#include <array>
#include <numbers>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/export/gltf_file.hpp"
#include "samara/export/shape_pose.hpp"
#include "samara/export/usd_file.hpp"
#include "samara/formats/display_mesh_file.hpp"
#include "support/painted_mesh.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using nlohmann::json;
using test::TemporaryFolder;
using testing::HasSubstr;

/// Copies of a body that looks like the painted mesh.
Motion painted_motion(const TemporaryFolder& folder, int copies) {
    (void)folder.file("leaf.mtl", test::painted_mtl);
    (void)folder.file("leaf.png", test::painted_png());
    Motion motion = test::motion_of(test::wander, 0.5);
    BodyMotion& body = motion.bodies[0];
    body.display = std::make_shared<const DisplayMesh>(
        read_display_mesh_file(folder.file("leaf.obj", test::painted_obj)));
    test::let_wander(body, copies, motion.times);
    return motion;
}

TEST(Display, IsSoundToTheKhronosValidator) {
    const TemporaryFolder folder;
    write_glb(folder / "motion.glb", painted_motion(folder, 3), 0, 0.0);
    const int status = run_subprocess({"node", SAMARA_SOURCE_DIRECTORY "/tests/tools/validate_gltf.mjs",
                                       SAMARA_NODE_TOOLS, folder / "motion.glb"},
                                      folder / "found.json");
    const std::string text = read_bytes(folder / "found.json");
    EXPECT_EQ(status, 0) << text.substr(0, 2000);
    const json found = json::parse(text, nullptr, false);
    EXPECT_EQ(found["info"]["materialCount"], 2);
    EXPECT_EQ(found["info"]["totalTriangleCount"], 4);
    EXPECT_EQ(found["info"]["maxUVs"], 1);
    const std::string resources = found["info"]["resources"].dump();
    EXPECT_THAT(resources, HasSubstr(R"("mimeType":"image/png")"));
    EXPECT_THAT(resources, HasSubstr(R"("width":1)"));
}

json read_by_three(const std::filesystem::path& file, const TemporaryFolder& folder) {
    const int status = run_subprocess(
        {"node", SAMARA_SOURCE_DIRECTORY "/tests/tools/read_gltf.mjs", SAMARA_NODE_TOOLS, file},
        folder / "found.json");
    const std::string text = read_bytes(folder / "found.json");
    EXPECT_EQ(status, 0) << text.substr(0, 2000);
    return json::parse(text, nullptr, false);
}

TEST(Instances, ArriveInThreeWithTheirPlacesSizesAndColors) {
    const TemporaryFolder folder;
    Motion motion = test::motion_of(test::wander, 0.0);
    BodyMotion& body = motion.bodies[0];
    body.center_of_mass = Vector3d(0.01, 0.02, -0.03);
    test::let_wander(body, 5, motion.times);
    body.sizes = {1.0, 0.5, 2.0, 1.5, 1.0};
    const CopyStyle style{.colors = {{1.0, 0.0, 0.0}, {0.0, 0.25, 0.5}}};
    write_glb(folder / "still.glb", motion, 0, std::nullopt, style, true);
    const json meshes = read_by_three(folder / "still.glb", folder);
    ASSERT_EQ(meshes.size(), 2U);
    const Matrix3d up = Eigen::AngleAxisd(-std::numbers::pi / 2.0, Vector3d::UnitX()).toRotationMatrix();
    for (std::size_t color = 0; color < 2; ++color) {
        EXPECT_EQ(meshes[color]["instanced"], true);
        EXPECT_EQ(meshes[color]["triangles"], body.surface.triangle_count());
        const Vector3d& expected = style.colors[color];
        EXPECT_EQ(meshes[color]["color"], (json{expected.x(), expected.y(), expected.z()}));
        const json& matrices = meshes[color]["matrices"];
        ASSERT_EQ(matrices.size(), 3U - color);
        for (std::size_t i = 0; i < matrices.size(); ++i) {
            const auto copy = static_cast<int>(2 * i + color);
            const auto columns = matrices[i].get<std::vector<double>>();
            const Eigen::Matrix4d is = Eigen::Map<const Eigen::Matrix4d>(columns.data());
            const ShapePose pose = shape_poses(motion, body, 0, copy).front();
            EXPECT_LT((is.topRightCorner<3, 1>() - up * pose.position).norm(), 1e-6);
            EXPECT_LT((is.topLeftCorner<3, 3>() -
                       body.size(0, copy) * (up * pose.orientation.toRotationMatrix() * up.transpose()))
                          .norm(),
                      1e-6);
        }
    }
}

TEST(Instances, AreRejectedByAReaderThatDoesNotKnowThem) {
    const TemporaryFolder folder;
    Motion motion = test::motion_of(test::wander, 0.0);
    test::let_wander(motion.bodies[0], 3, motion.times);
    write_glb(folder / "still.glb", motion, 0, std::nullopt, {}, true);
    run_subprocess(
        {"blender", "-b", "--factory-startup", "--python",
         SAMARA_SOURCE_DIRECTORY "/tests/tools/read_in_blender.py", "--", "60", "1", folder / "still.glb"},
        folder / "log");
    const std::string log = read_bytes(folder / "log");
    EXPECT_THAT(log, HasSubstr("EXT_mesh_gpu_instancing"));
    EXPECT_THAT(log, testing::Not(HasSubstr("FOUND")));
}

TEST(Display, ArrivesInUsdWithItsSubsetsMaterialsAndUVs) {
    const TemporaryFolder folder;
    for (const int copies : {2, most_usd_transforms + 1}) {
        write_usda(folder / "motion.usda", painted_motion(folder, copies), 0, 0.0);
        const int status = run_subprocess({"node", SAMARA_SOURCE_DIRECTORY "/tests/tools/read_usd.mjs",
                                           SAMARA_NODE_TOOLS, folder / "motion.usda"},
                                          folder / "found.json");
        const std::string text = read_bytes(folder / "found.json");
        ASSERT_EQ(status, 0) << text.substr(0, 2000);
        const std::string stage = json::parse(text)["tinyusdz"]["text"];
        EXPECT_THAT(stage, HasSubstr("primvars:st"));
        EXPECT_THAT(stage, HasSubstr("GeomSubset \"leaf_front\""));
        EXPECT_THAT(stage, HasSubstr("GeomSubset \"stalk\""));
        EXPECT_THAT(stage, HasSubstr("Material \"stalk\""));
        EXPECT_THAT(stage, HasSubstr("UsdPreviewSurface"));
        EXPECT_THAT(stage, HasSubstr("UsdUVTexture"));
        EXPECT_THAT(stage, HasSubstr("@./motion.images/leaf.png@"));
        EXPECT_EQ(read_bytes(folder / "motion.images/leaf.png"), test::painted_png());
    }
}

TEST(Display, ArrivesInBlenderWithItsSlotsAndUVs) {
    const TemporaryFolder folder;
    write_glb(folder / "motion.glb", painted_motion(folder, 1), 0, 0.0);
    ASSERT_EQ(run_subprocess({"blender", "-b", "--factory-startup", "--python",
                              SAMARA_SOURCE_DIRECTORY "/tests/tools/read_in_blender.py", "--", "60", "1",
                              folder / "motion.glb"},
                             folder / "log"),
              0);
    const std::string log = read_bytes(folder / "log");
    const std::size_t place = log.find("\nFOUND ");
    ASSERT_NE(place, std::string::npos) << log;
    const json found = json::parse(log.substr(place + 7, log.find('\n', place + 7) - place - 7));
    const json& object = *found["objects"].begin();
    EXPECT_EQ(object["materials"], (json{"leaf_front", "stalk"}));
    EXPECT_EQ(object["slots"], (json{0, 0, 1, 1}));
    EXPECT_EQ(object["images"].dump(), R"([["leaf",1,1]])");
    std::set<std::array<double, 2>> places;
    for (const json& uv : object["uvs"]) {
        places.insert({std::round(100.0 * uv[0].get<double>()) / 100.0,
                       std::round(100.0 * uv[1].get<double>()) / 100.0});
    }
    EXPECT_EQ(places, (std::set<std::array<double, 2>>{{0.0, 0.0},
                                                       {0.5, 0.0},
                                                       {0.5, 1.0},
                                                       {0.0, 1.0},
                                                       {0.75, 0.25},
                                                       {1.0, 0.25},
                                                       {1.0, 0.75},
                                                       {0.75, 0.75}}));
}

}  // namespace
}  // namespace samara
