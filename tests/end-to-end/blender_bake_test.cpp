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

}  // namespace
}  // namespace samara
