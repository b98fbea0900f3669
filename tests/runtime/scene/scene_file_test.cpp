#include "samara/scene/scene_file.hpp"

#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/core/base/error.hpp"
#include "support/expect_error.hpp"

namespace samara {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// A folder with an (empty) shape file and one scene in it, removed at the end.
class SceneFile : public testing::Test {
  protected:
    SceneFile() {
        std::filesystem::create_directories(folder_);
        std::ofstream(folder_ / "ball.stl") << "solid\n";
    }
    ~SceneFile() override { std::filesystem::remove_all(folder_); }

    Scene read(const std::string& text) {
        std::ofstream(folder_ / "scene.toml") << text;
        return read_scene_file(folder_ / "scene.toml");
    }

    /// The message of the Error that reading this text throws.
    std::string rejection(const std::string& text) {
        try {
            read(text);
        } catch (const Error& error) {
            return error.what();
        }
        return "accepted";
    }

    static std::string with_body(const std::string& keys) {
        return "[scene]\nduration = 1.0\n[[body]]\nname = \"ball\"\nshape = \"ball.stl\"\n" + keys;
    }

    const std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) /
                                          testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(SceneFile, ValuesNotGivenHaveTheirDocumentedDefaults) {
    const Scene scene = read(with_body("density = 1200"));
    EXPECT_EQ(scene.step, 0.002);
    EXPECT_EQ(scene.frame_rate, 60.0);
    EXPECT_EQ(scene.seed, 1U);
    EXPECT_EQ(scene.gravity, Vector3d(0, 0, -9.81));
    EXPECT_EQ(scene.fluid.density, 998.2);
    EXPECT_FALSE(scene.ground.has_value());
    EXPECT_TRUE(scene.fluid.gust.amplitude.isZero(0.0));
    EXPECT_EQ(scene.bodies.at(0).loads, Loads::table);
    EXPECT_EQ(scene.bodies.at(0).turbulence, Turbulence::table);
    EXPECT_EQ(scene.bodies.at(0).langevin, Langevin::wake);
    EXPECT_TRUE(scene.bodies.at(0).added_mass);
    EXPECT_EQ(scene.bodies.at(0).dynamic, Dynamic::of_body);
    EXPECT_FALSE(scene.bodies.at(0).table_reynolds_number.has_value());
    EXPECT_FALSE(scene.bodies.at(0).models_auto);
    EXPECT_EQ(scene.bodies.at(0).shape, folder_ / "ball.stl");
}

TEST_F(SceneFile, EveryKeyIsRead) {
    const Scene scene = read(
        "[scene]\nduration = 2\nstep = 0.01\nframe_rate = 24\nseed = 9\ngravity = [0, 1, 0]\n"
        "ground = -2\n[fluid]\ndensity = 2.0\nviscosity = 0.5\ncurrent = [1, 2, 3]\n"
        "gust = { amplitude = [0, 0.5, 0], period = 2 }\n"
        "[[body]]\nname = \"a\"\nshape = \"ball.stl\"\nscale = 0.5\nmass = 3\ncenter_of_mass = [0.1, 0, 0]\n"
        "inertia = [1, 2, 2.5]\nposition = [1, 1, 1]\norientation = [0, 2, 0, 0]\nvelocity = [1, 0, 0]\n"
        "angular_velocity = [0, 1, 0]\nstart = 0.5\ncount = 3\nspread = { position = [1, 2, 3], angle = 0.5, "
        "size = [0.5, 2], start = 1.5 }\n"
        "loads = \"coefficients\"\ndrag_coefficient = 1.3\nlift_coefficient = 0.2\nreference_area = 0.1\n"
        "normal = [0, 0, 2]\ncenter_of_pressure = [0, 0, 0.1]\nturbulence = \"constant\"\n"
        "turbulent_kinetic_energy = 0.1\ndissipation_rate = 0.2\nlangevin = \"body-velocity\"\n");
    const SceneBody& body = scene.bodies.at(0);
    EXPECT_EQ(scene.ground, -2.0);
    EXPECT_EQ(scene.fluid.current, Vector3d(1, 2, 3));
    EXPECT_EQ(scene.fluid.gust.amplitude, Vector3d(0, 0.5, 0));
    EXPECT_EQ(scene.fluid.gust.period, 2.0);
    EXPECT_EQ(body.mass.mass, 3.0);
    EXPECT_EQ((*body.mass.inertia)(2, 2), 2.5);
    EXPECT_EQ(body.orientation.coeffs(), Eigen::Vector4d(1, 0, 0, 0));
    EXPECT_EQ(body.spread_angle, 0.5);
    EXPECT_EQ(body.smallest_size, 0.5);
    EXPECT_EQ(body.largest_size, 2.0);
    EXPECT_EQ(body.spread_start, 1.5);
    EXPECT_EQ(body.coefficients.normal, Vector3d(0, 0, 1));
    EXPECT_EQ(body.turbulence, Turbulence::constant);
    EXPECT_EQ(body.langevin, Langevin::body_velocity);
}

TEST_F(SceneFile, ASpreadOfSizesIsTwoNumbersInOrder) {
    for (const char* sizes : {"[2, 1]", "[0, 1]", "[1, 5000]", "[-1, 1]"}) {
        EXPECT_THAT(
            rejection(with_body(std::string("density = 1\ncount = 2\nspread = { size = ") + sizes + " }\n")),
            AllOf(HasSubstr("size"), HasSubstr("the smallest and the largest")));
    }
}

TEST_F(SceneFile, ASpreadOfOneCopyIsRefused) {
    for (const char* spread : {"position = [0, 0, 0.1]", "angle = 0.5", "start = 1", "size = [0.5, 2]"}) {
        const std::string keys = std::string("spread = { ") + spread + " }\n";
        EXPECT_THAT(rejection(with_body("density = 1\n" + keys)),
                    AllOf(HasSubstr("count in [[body]] is 1, but"), HasSubstr("needs several")));
        EXPECT_NO_THROW(read(with_body("density = 1\ncount = 2\n" + keys)));
    }
    EXPECT_NO_THROW(read(with_body("density = 1\nspread = { size = [2, 2], angle = 0 }\n")))
        << "it has that size";
}

TEST_F(SceneFile, AnEmitterHasTheKeysOfAnObstacleAndTakesThePlaceOfAPosition) {
    std::ofstream(folder_ / "tree.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const std::string emitter =
        "emitter = { shape = \"tree.obj\", scale = 2, position = [0, 0, 3], offset = 0.1, speed = 0.5, "
        "keys = [{ time = 1, position = [1, 0, 3] }, { time = 2 }] }\n";
    const SceneBody body = read(with_body("density = 1\n" + emitter)).bodies.at(0);
    ASSERT_NE(body.emitter, nullptr);
    EXPECT_EQ(body.emitter->mesh.surface.vertices.at(1), Vector3d(2, 0, 0));
    EXPECT_EQ(body.emitter->mesh.keys.size(), 2U);
    EXPECT_EQ(body.emitter->offset, 0.1);
    EXPECT_EQ(body.emitter->speed, 0.5);
    EXPECT_THAT(rejection(with_body("density = 1\nposition = [0, 0, 1]\n" + emitter)),
                AllOf(HasSubstr("position"), HasSubstr("excludes emitter")));
    EXPECT_THAT(rejection(with_body("density = 1\nemitter = { shape = \"tree.obj\", keys = [{ time = 0 }, "
                                    "{ time = 0.001, position = [9, 0, 0] }] }\n")),
                AllOf(HasSubstr("keys"), HasSubstr("are too fast: from 0 s to 0.001 s")));
    EXPECT_THAT(rejection(with_body("density = 1\nemitter = { shape = \"none.obj\" }\n")),
                HasSubstr("cannot be read"));
}

TEST_F(SceneFile, ModelsAreSwitchedBodyByBody) {
    const auto body = [&](const std::string& keys) {
        return read(with_body("density = 1\n" + keys)).bodies.at(0);
    };
    EXPECT_FALSE(body("added_mass = false").added_mass);
    EXPECT_TRUE(body("added_mass = true").added_mass);
    EXPECT_EQ(body("dynamic_coefficients = \"body\"").dynamic, Dynamic::of_body);
    EXPECT_EQ(body("dynamic_coefficients = \"default\"").dynamic, Dynamic::by_default);
    EXPECT_EQ(body("dynamic_coefficients = \"none\"").dynamic, Dynamic::none);
    EXPECT_EQ(body("table_reynolds_number = 1e4").table_reynolds_number, 1e4);
    EXPECT_EQ(body("").patches, 1);
    EXPECT_EQ(body("patches = 8").patches, 8);
    EXPECT_FALSE(body("models = \"given\"\nloads = \"none\"").models_auto);
    EXPECT_TRUE(body("models = \"auto\"\nlangevin = \"seen-fluid\"").models_auto);
}

TEST_F(SceneFile, LoadsOfTheSurfaceAreAskedForOrLeftToWhatTheBodyHolds) {
    const auto body = [&](const std::string& keys) {
        return read(with_body("density = 1\n" + keys)).bodies.at(0);
    };
    EXPECT_EQ(body("loads = \"surface\"").loads, Loads::surface);
    EXPECT_EQ(body("loads = \"surface\"").turbulence, Turbulence::table);
    EXPECT_FALSE(body("loads = \"surface\"").open.loads);
    EXPECT_TRUE(body("").open.loads);
    EXPECT_TRUE(body("").open.patches);
    EXPECT_FALSE(body("patches = 1").open.patches);
    EXPECT_TRUE(body("").open.turbulence);
    EXPECT_FALSE(body("turbulence = \"none\"").open.turbulence);
    EXPECT_THAT(rejection(with_body("density = 1\nloads = \"surface\"\ntable_reynolds_number = 1e4")),
                AllOf(HasSubstr("scene.toml:8: table_reynolds_number"), HasSubstr("\"table\"")));
}

TEST_F(SceneFile, ModelsThatAreChosenAreNotGivenToo) {
    for (const std::string key : {"loads = \"table\"", "added_mass = true", "dynamic_coefficients = \"body\"",
                                  "table_reynolds_number = 1e4", "turbulence = \"none\""}) {
        const std::string name = key.substr(0, key.find(' '));
        EXPECT_THAT(rejection(with_body("density = 1\nmodels = \"auto\"\n" + key)),
                    AllOf(HasSubstr("scene.toml:8: " + name), HasSubstr("models = \"auto\"")));
    }
    for (const char* count : {"0", "33", "2.5"}) {
        EXPECT_THAT(rejection(with_body(std::string("density = 1\npatches = ") + count)),
                    HasSubstr("scene.toml:7: patches"));
    }
    EXPECT_THAT(rejection(with_body("density = 1\nloads = \"none\"\npatches = 8")),
                HasSubstr("scene.toml:8: patches"));
    EXPECT_THAT(rejection(with_body("density = 1\nmodels = \"best\"")), HasSubstr("scene.toml:7: models"));
    EXPECT_THAT(rejection(with_body("density = 1\nadded_mass = 1")), HasSubstr("must be true or false"));
    EXPECT_THAT(rejection(with_body("density = 1\ndynamic_coefficients = \"all\"")),
                HasSubstr("\"default\""));
    EXPECT_THAT(rejection(with_body("density = 1\nloads = \"none\"\ntable_reynolds_number = 1e4")),
                HasSubstr("scene.toml:8: table_reynolds_number"));
    EXPECT_THAT(rejection(with_body("density = 1\ntable_reynolds_number = 0")),
                HasSubstr("scene.toml:7: table_reynolds_number"));
}

TEST_F(SceneFile, AnUnknownKeyIsNamedWithItsLine) {
    EXPECT_THAT(rejection(with_body("density = 1\ncolour = 3\n")),
                HasSubstr("scene.toml:7: unknown key 'colour'"));
    EXPECT_THAT(rejection("[scene]\nduration = 1\ngravty = 3\n"),
                HasSubstr("scene.toml:3: unknown key 'gravty' in [scene]; did you mean 'gravity'?"));
    EXPECT_THAT(rejection(with_body("density = 1\n[extra]\n")), HasSubstr("unknown key 'extra'"));
}

TEST_F(SceneFile, AMisspeltKeyIsNamedBeforeTheKeyThatItLeavesMissing) {
    EXPECT_THAT(rejection(with_body("densty = 1\n")),
                HasSubstr("scene.toml:6: unknown key 'densty' in [[body]]; did you mean 'density'?"));
    EXPECT_THAT(rejection("[scene]\nDuration = 1\n"), HasSubstr("scene.toml:2: unknown key 'Duration'"));
    EXPECT_THAT(rejection("[scnee]\nduration = 1\n"), HasSubstr("did you mean 'scene'?"));
    EXPECT_THAT(rejection("[scene]\nduration = 1\n[[body]]\nname = \"a\"\nscale = 2\n"),
                HasSubstr("shape in [[body]] is missing"));
}

TEST_F(SceneFile, TheStepIsANumberOrLeftToTheAdviceWithATolerance) {
    const auto with_step = [](const std::string& keys) {
        return "[scene]\nduration = 1\n" + keys +
               "\n[[body]]\nname = \"ball\"\nshape = \"ball.stl\"\ndensity = 2\n";
    };
    EXPECT_FALSE(read(with_step("step = 0.01")).step_auto);
    const Scene scene = read(with_step("step = \"auto\""));
    EXPECT_TRUE(scene.step_auto);
    EXPECT_EQ(scene.step_tolerance, 0.005);
    EXPECT_EQ(read(with_step("step = \"auto\"\nstep_tolerance = 1e-3")).step_tolerance, 1e-3);
    EXPECT_THAT(rejection(with_step("step = \"fast\"")),
                HasSubstr("scene.toml:3: step in [scene] must be a number of seconds, or \"auto\""));
    EXPECT_THAT(rejection(with_step("step_tolerance = 1e-3")),
                HasSubstr("scene.toml:3: step_tolerance in [scene] applies only to step = \"auto\""));
    EXPECT_THAT(rejection(with_step("step = \"auto\"\nstep_tolerance = 1")),
                HasSubstr("scene.toml:4: step_tolerance in [scene] must lie between"));
}

TEST_F(SceneFile, ThePrecisionIsDoubleOrSingleAndSingleWhereBodiesDoNotMeet) {
    const auto with = [](const std::string& keys) {
        return "[scene]\nduration = 1\n" + keys +
               "\n[[body]]\nname = \"ball\"\nshape = \"ball.stl\"\ndensity = 2\n";
    };
    EXPECT_EQ(read(with("")).precision, Precision::double_precision);
    EXPECT_EQ(read(with("precision = \"double\"")).precision, Precision::double_precision);
    EXPECT_EQ(read(with("precision = \"single\"")).precision, Precision::single_precision);
    EXPECT_THAT(rejection(with("precision = \"half\"")),
                HasSubstr("scene.toml:3: precision in [scene] must be one of \"double\", \"single\""));
    EXPECT_THAT(rejection(with("precision = \"single\"\nbodies_collide = true")),
                HasSubstr("scene.toml:3: precision in [scene] must be \"double\" where bodies_collide"));
}

TEST_F(SceneFile, ARotationIsInDegreesAboutXThenYThenZ) {
    const Quaterniond turned = read(with_body("density = 1\nrotation = [90, 0, 90]")).bodies[0].orientation;
    // About x first: y becomes z; then about z: x becomes y.
    EXPECT_LT((turned * Vector3d::UnitY() - Vector3d::UnitZ()).norm(), 1e-12);
    EXPECT_LT((turned * Vector3d::UnitX() - Vector3d::UnitY()).norm(), 1e-12);
    EXPECT_THAT(rejection(with_body("density = 1\nrotation = [0, 0, 1]\norientation = [1, 0, 0, 0]")),
                HasSubstr("rotation in [[body]] excludes orientation"));
}

TEST_F(SceneFile, AMassByAreaIsInGramsAndExcludesTheOthers) {
    EXPECT_DOUBLE_EQ(*read(with_body("area_density = 80")).bodies[0].mass.area_density, 0.08);
    EXPECT_THAT(rejection(with_body("area_density = 80\nmass = 1")), HasSubstr("give one of the three"));
    EXPECT_THAT(rejection(with_body("area_density = 80\ninertia = [1, 1, 1]")),
                HasSubstr("give mass instead"));
}

TEST_F(SceneFile, AScaleOfABodyFileIsASizeAndWhatTheSceneSaysIsOfThatSize) {
    const auto body = [&](const std::string& keys) {
        return read("[scene]\nduration = 1\n[[body]]\nname = \"a\"\nshape = \"samara:leaf\"\n" + keys)
            .bodies[0];
    };
    const SceneBody twice = body(
        "scale = 2\nmass = 0.008\ncenter_of_mass = [0, 0.02, 0]\ncount = 2\n"
        "spread = { size = [0.5, 1] }");
    EXPECT_EQ(twice.scale, 1.0);
    EXPECT_EQ(twice.smallest_size, 1.0);
    EXPECT_EQ(twice.largest_size, 2.0);
    EXPECT_DOUBLE_EQ(*twice.mass.mass, 0.001);
    EXPECT_DOUBLE_EQ(twice.mass.center_of_mass->y(), 0.01);
    EXPECT_TRUE(body("scale = 2").spreads_size());
    EXPECT_THAT(test::error_of([&] { body("scale = 2000"); }), HasSubstr("scale"));
    EXPECT_THAT(test::error_of([&] { body("thickness = 0.001"); }), HasSubstr("open sheet"));
}

TEST_F(SceneFile, AValueOutOfRangeIsRefusedWithItsLine) {
    EXPECT_THAT(rejection(with_body("density = -1")), HasSubstr("scene.toml:6: density"));
    EXPECT_THAT(rejection(with_body("density = nan")), HasSubstr("scene.toml:6: density"));
    EXPECT_THAT(rejection(with_body("density = 1\nposition = [0, inf, 0]")),
                HasSubstr("scene.toml:7: position"));
    EXPECT_THAT(rejection(with_body("density = 1\norientation = [0, 0, 0, 0]")), HasSubstr("not zero"));
    EXPECT_THAT(rejection("[scene]\nduration = 0\n"), HasSubstr("scene.toml:2: duration"));
    EXPECT_THAT(rejection(with_body("density = 1\ncount = 0")), HasSubstr("count"));
    EXPECT_THAT(rejection(with_body("density = 1\nloads = \"magic\"")), HasSubstr("\"table\""));
}

TEST_F(SceneFile, AGustNeedsAFiniteAmplitudeAndAPeriodAboveZero) {
    const auto with_gust = [&](const std::string& gust) {
        return rejection("[scene]\nduration = 1\n[fluid]\ngust = { " + gust + " }\n");
    };
    EXPECT_THAT(with_gust("amplitude = [0, 0, 1]"), HasSubstr("scene.toml:4: period in [gust] is missing"));
    EXPECT_THAT(with_gust("period = 1"), HasSubstr("amplitude in [gust] is missing"));
    EXPECT_THAT(with_gust("amplitude = [0, 0, 1], period = 0"), HasSubstr("period in [gust] must be"));
    EXPECT_THAT(with_gust("amplitude = [0, nan, 1], period = 1"), HasSubstr("amplitude in [gust] must"));
    EXPECT_THAT(with_gust("amplitude = [0, 0, 1], period = 1, phase = 1"), HasSubstr("unknown key 'phase'"));
    EXPECT_THAT(rejection("[scene]\nduration = 1\nground = inf\n"), HasSubstr("scene.toml:3: ground"));
}

TEST_F(SceneFile, AMissingFileOrKeyIsNamed) {
    EXPECT_THAT(
        rejection("[scene]\nduration = 1\n[[body]]\nname = \"a\"\nshape = \"gone.stl\"\ndensity = 1\n"),
        HasSubstr("gone.stl"));
    EXPECT_THAT(rejection("[scene]\nduration = 1\n"), HasSubstr("no [[body]]"));
    EXPECT_THAT(rejection(with_body("")), HasSubstr("density"));
    EXPECT_THROW(read_scene_file(folder_ / "absent.toml"), Error);
}

TEST_F(SceneFile, ContradictionsAreRefused) {
    EXPECT_THAT(rejection(with_body("density = 1\nmass = 1")), HasSubstr("one of the two"));
    EXPECT_THAT(rejection(with_body("density = 1\ninertia = [1, 1, 1]")), HasSubstr("give mass instead"));
    EXPECT_THAT(rejection(with_body("center_of_mass = [0, 0, 0]")), HasSubstr("give mass too"));
    EXPECT_THAT(rejection(with_body("density = 1\ndrag_coefficient = 1")),
                HasSubstr("loads = \"coefficients\""));
    EXPECT_THAT(rejection(with_body("density = 1\nturbulence = \"constant\"")),
                HasSubstr("turbulent_kinetic_energy"));
    EXPECT_THAT(
        rejection(with_body("density = 1\n[[body]]\nname = \"ball\"\nshape = \"ball.stl\"\ndensity = 1\n")),
        HasSubstr("of another body"));
    EXPECT_THAT(rejection("[scene]\nduration = 1\n[fluid]\npreset = \"air\"\ndensity = 1\n"),
                HasSubstr("preset"));
}

TEST_F(SceneFile, BrokenTomlIsNamedWithItsLine) {
    EXPECT_THAT(rejection("[scene]\nduration = \n"), HasSubstr("scene.toml:2"));
    EXPECT_THAT(rejection("[scene]\nduration = \n"), testing::Not(HasSubstr("give a scene")));
    EXPECT_THAT(test::error_of([&] { (void)read_scene_file(folder_ / "ball.stl"); }),
                HasSubstr("give a scene file (.toml)"));
}

}  // namespace
}  // namespace samara
