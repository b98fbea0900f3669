// Looks in readers that know nothing of samara: the Khronos validator, TinyUSDZ and three.js, Blender.

#include <array>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/export/gltf_file.hpp"
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
    EXPECT_EQ(found["info"]["materialCount"], 3);
    EXPECT_EQ(found["info"]["totalTriangleCount"], 4);
    EXPECT_EQ(found["info"]["maxUVs"], 1);
    const std::string resources = found["info"]["resources"].dump();
    EXPECT_THAT(resources, HasSubstr(R"("mimeType":"image/png")"));
    EXPECT_THAT(resources, HasSubstr(R"("width":1)"));
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
