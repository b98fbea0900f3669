// [wind] in a scene file, and what is rejected.

#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paths.hpp"
#include "samara/core/wind/wind_file.hpp"
#include "samara/scene/scene_file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using ::testing::HasSubstr;

/// A scene whose wind has these lines; [wind] is line 8.
Scene scene_with(const std::string& wind, const std::string& of_scene = "seed = 9") {
    const test::TemporaryFolder folder;
    return read_scene_file(folder.file(
        "scene.toml", fmt::format("[scene]\nduration = 1.0\n{}\n[[body]]\nname = \"leaf\"\n"
                                  "shape = \"{}/runtime/bodies/leaf.body.h5\"\ndensity = 600\n[wind]\n{}\n",
                                  of_scene, SAMARA_SOURCE_DIRECTORY, wind)));
}

void expect_rejected(const std::string& wind, const std::string& message) {
    EXPECT_THAT(test::error_of([&] { scene_with(wind); }), HasSubstr(message)) << wind;
}

TEST(WindTable, OfASceneWithoutIsCalm) {
    EXPECT_TRUE(scene_with("").wind.is_calm());
    EXPECT_FALSE(scene_with("velocity = [1, 0, 0]").wind.is_calm());
    EXPECT_FALSE(scene_with("velocity = [1, 0, 0]").wind.is_field());
}

TEST(WindTable, FallsOffTowardsSurfacesUnlessItIsAUniformVelocityAlone) {
    EXPECT_FALSE(scene_with("velocity = [1, 0, 0]").wind.is_field());
    EXPECT_FALSE(scene_with("gusts = { rms = 1, length = 1 }").wind.surface_layer.has_value());
    const Wind wind =
        scene_with("velocity = [1, 0, 0]\nsurface_layer = { height = 0.2, roughness = 0.01 }").wind;
    EXPECT_EQ(wind.surface_layer, (WindSurfaceLayer{.height = 0.2, .roughness = 0.01}));
    EXPECT_TRUE(wind.is_field());
    EXPECT_EQ(scene_with("surface_layer = { height = 0 }").wind.surface_layer->height, 0.0);
}

TEST(WindTable, HoldsWhatItSays) {
    const Wind wind = scene_with(R"(velocity = [3, 1, 0]
profile = { law = "power", exponent = 0.2, height = 4 }
gusts = { spectrum = "kaimal", rms = 0.5, length = 2, seed = 7, bands = 20 }
[[wind.vortex]]
kind = "rankine"
position = [1, 2, 3]
axis = [0, 0, -2]
circulation = -1.5
core = 0.3
velocity = [0.1, 0, 0]
[[wind.fan]]
position = [0, 0, 1]
direction = [0, 3, 0]
diameter = 0.5
speed = 4
[[wind.fan]]
position = [0, 0, 2]
direction = [1, 0, 0]
speed = 2)",
                                 "ground = -0.5")
                          .wind;
    EXPECT_EQ(wind.velocity, Vector3d(3, 1, 0));
    EXPECT_EQ(*wind.profile, (WindProfile{.law = WindProfile::Law::power,
                                          .roughness = WindProfile{}.roughness,
                                          .exponent = 0.2,
                                          .height = 4.0,
                                          .ground = -0.5}));
    EXPECT_EQ(
        *wind.gusts,
        (WindGusts{
            .spectrum = WindGusts::Spectrum::kaimal, .rms = 0.5, .length = 2.0, .seed = 7, .bands = 20}));
    ASSERT_EQ(wind.vortices.size(), 1u);
    EXPECT_EQ(wind.vortices[0], (WindVortex{.type = WindVortex::Core::rankine,
                                            .position = Vector3d(1, 2, 3),
                                            .axis = Vector3d(0, 0, -1),
                                            .circulation = -1.5,
                                            .core = 0.3,
                                            .velocity = Vector3d(0.1, 0, 0)}));
    ASSERT_EQ(wind.fans.size(), 2u);
    EXPECT_EQ(
        wind.fans[0],
        (WindFan{
            .position = Vector3d(0, 0, 1), .direction = Vector3d(0, 1, 0), .diameter = 0.5, .speed = 4.0}));
}

TEST(WindTable, RefusesWithOneLineThatNamesThePlace) {
    expect_rejected("velocity = [1, nan, 0]", "scene.toml:9: velocity in [wind] must");
    expect_rejected("velocity = 3", "scene.toml:9: velocity in [wind] must be a list of 3 numbers");
    expect_rejected("speed = 3", "scene.toml:9: unknown key 'speed' in [wind]");
    expect_rejected("vortex = 3", "vortex in [wind] must be written as [[vortex]]");
    expect_rejected("profile = { law = \"log\" }", "velocity in [wind] is missing");
    expect_rejected("velocity = [1, 0, 1]\nprofile = { law = \"log\" }",
                    "scene.toml:9: velocity in [wind] must be horizontal");
    const auto profile = [](const std::string& keys, const std::string& message) {
        expect_rejected("velocity = [1, 0, 0]\nprofile = { " + keys + " }", "scene.toml:10: " + message);
    };
    profile("height = 3", "law in [profile] is missing");
    profile("law = \"linear\"", "law in [profile] must be one of \"log\", \"power\"");
    profile("law = \"log\", height = -10", "height in [profile] must be a finite number above 0");
    profile("law = \"log\", roughness = 0", "roughness in [profile] must");
    profile("law = \"log\", exponent = 0.1", "exponent in [profile] applies only to law = \"power\"");
    profile("law = \"power\", roughness = 0.1", "roughness in [profile] applies only to law = \"log\"");
    profile("law = \"power\", exponent = 1.5", "exponent in [profile] must");
    profile("law = \"log\", ground = inf", "ground in [profile] must");
    profile("law = \"log\", hight = 2", "unknown key 'hight' in [profile]; did you mean 'height'?");
    const auto gusts = [](const std::string& keys, const std::string& message) {
        expect_rejected("gusts = { " + keys + " }", "scene.toml:9: " + message);
    };
    gusts("length = 1", "rms in [gusts] is missing");
    gusts("rms = 1", "length in [gusts] is missing");
    gusts("rms = -1, length = 1", "rms in [gusts] must");
    gusts("rms = 1, length = 0", "length in [gusts] must");
    gusts("rms = 1, length = 1, spectrum = \"pink\"", "spectrum in [gusts] must be one of");
    gusts("rms = 1, length = 1, bands = 0", "bands in [gusts] must be a whole number from 1 to 1000");
    gusts("rms = 1, length = 1, seed = -1", "seed in [gusts] must");
    const auto vortex = [](const std::string& keys, const std::string& message) {
        expect_rejected("vortex = [{ " + keys + " }]", "scene.toml:9: " + message);
    };
    vortex("core = 1", "circulation in [[vortex]] is missing");
    vortex("circulation = 1", "core in [[vortex]] is missing");
    vortex("circulation = inf, core = 1", "circulation in [[vortex]] must");
    vortex("circulation = 1, core = -1", "core in [[vortex]] must");
    vortex("circulation = 1, core = 1, axis = [0, 0, 0]", "axis in [[vortex]] must not be the zero vector");
    const auto fan = [](const std::string& keys, const std::string& message) {
        expect_rejected("fan = [{ " + keys + " }]", "scene.toml:9: " + message);
    };
    fan("direction = [1, 0, 0], speed = 1", "position in [[fan]] is missing");
    fan("position = [1, 0, 0], speed = 1", "direction in [[fan]] is missing");
    fan("position = [1, 0, 0], direction = [1, 0, 0]", "speed in [[fan]] is missing");
    fan("position = [1, 0, 0], direction = [0, 0, 0], speed = 1", "direction in [[fan]] must not");
    fan("position = [1, 0, 0], direction = [1, 0, 0], speed = 1, diameter = 0", "diameter in [[fan]] must");
}

/// The file of a wind that lasts a second.
std::filesystem::path wind_file_in(const test::TemporaryFolder& folder, std::size_t frames) {
    WindGrid grid;
    grid.frames = frames;
    grid.interval = 0.5;
    grid.velocities.assign(grid.size(), 2.0F);
    const std::filesystem::path file = folder.path() / "gust.h5";
    write_wind_file(file, grid);
    return file;
}

TEST(WindTable, TakesAFile) {
    const test::TemporaryFolder folder;
    const std::string path = wind_file_in(folder, 3).string();
    const Wind wind =
        scene_with(
            fmt::format("[wind.file]\npath = \"{}\"\nposition = [1, 2, 3]\nstart = 0.5\noutside = \"still\"",
                        path))
            .wind;
    ASSERT_TRUE(wind.file);
    EXPECT_EQ(wind.file->grid->frames, 3U);
    EXPECT_EQ(wind.file->position, Vector3d(1, 2, 3));
    EXPECT_EQ(wind.file->start, 0.5);
    EXPECT_EQ(wind.file->outside, WindFile::Outside::still);
    EXPECT_FALSE(wind.file->repeats);
    EXPECT_TRUE(wind.is_field());
}

TEST(WindTable, RefusesAFileThatEndsBeforeTheScene) {
    const test::TemporaryFolder folder;
    const std::string path = wind_file_in(folder, 2).string();  // half a second, and the scene a whole one
    const std::string lines = fmt::format("[wind.file]\npath = \"{}\"\n", path);
    expect_rejected(lines, "holds the wind until 0.5 s, but the scene ends at 1 s; give repeat = true");
    EXPECT_TRUE(scene_with(lines + "repeat = true").wind.file->repeats);
    EXPECT_TRUE(scene_with(lines + "start = 0.5").wind.file);
    EXPECT_TRUE(
        scene_with(fmt::format("[wind.file]\npath = \"{}\"", wind_file_in(folder, 1).string())).wind.file);
    expect_rejected("[wind.file]\nstart = 1", "path in [file] is missing");
    expect_rejected("[wind.file]\npath = \"nowhere.h5\"", "nowhere.h5");
    expect_rejected(lines + "outside = \"far\"", "outside");
    expect_rejected(lines + "loop = true", "unknown key 'loop'");
}

}  // namespace
}  // namespace samara
