// The add-on in real Blender calls samara to bake a mesh: with OpenFOAM, and for the added mass alone.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paths.hpp"
#include "support/blender_addon.hpp"

namespace samara {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

void expect_ball(const json& found) {
    EXPECT_EQ(found["error"], "");
    EXPECT_THAT(found["file"].get<std::string>(), HasSubstr("Ball_20_1.body.h5"));
    for (const json& extent : found["extent"]) EXPECT_NEAR(extent.get<double>(), 0.04, 1e-3);
    EXPECT_EQ(found["simulate"], "");
}

TEST(BlenderBake, BakesTheMeshWithModifiersAndScaleAndReportsWhatSamaraRefuses) {
    const json found = test::use_addon({"bake", SAMARA_PROGRAMS "/samara", "SMOKE"});
    expect_ball(found);
    EXPECT_EQ(found["tables"], true);
    EXPECT_THAT(found["open"].get<std::string>(), HasSubstr("is not closed"));
}

TEST(BlenderBake, WorksOutTheAddedMassAloneWithoutOpenfoam) {
    const json found = test::use_addon({"bake", SAMARA_PROGRAMS "/samara", "SHAPE"});
    expect_ball(found);
    EXPECT_EQ(found["tables"], false);
    const auto error = [&](const char* name) { return found[name].get<std::string>(); };
    EXPECT_THAT(error("no_program"), HasSubstr("is not found"));
    EXPECT_THAT(error("open"), HasSubstr("is not closed"));
    EXPECT_THAT(error("negative"), HasSubstr("negative scale"));
    EXPECT_THAT(error("empty_of_faces"), HasSubstr("has no faces"));
    EXPECT_EQ(found["cancelled"], true);
}

TEST(BlenderBake, KeepsTheMeshsTrianglesOrMakesAsManyAsAreAskedFor) {
    const json found = test::use_addon({"meshing", SAMARA_PROGRAMS "/samara"});
    for (const char* name : {"kept", "few", "many"}) {
        EXPECT_EQ(found[std::string(name) + "_error"], "");
        EXPECT_EQ(found[name][1], true) << "it has its added mass";
        EXPECT_EQ(found[name][2], "Sphere");
    }
    EXPECT_EQ(found["kept"][0], found["own"]);
    // Curved triangles are shown as four each.
    EXPECT_NEAR(found["few"][0].get<double>(), 4.0 * 200.0, 0.2 * 800.0);
    EXPECT_NEAR(found["many"][0].get<double>(), 4.0 * 2000.0, 0.2 * 8000.0);
}

}  // namespace
}  // namespace samara
