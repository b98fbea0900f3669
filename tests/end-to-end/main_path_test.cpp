// The whole way with real gmsh, OpenFOAM, HDF5, matplotlib and the Khronos validator: a shape becomes a baked
// body, the body falls, and its motion leaves for other tools.

#include <cmath>
#include <fstream>
#include <numbers>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paths.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/dynamics/loads.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/scene/scene.hpp"
#include "support/program_run.hpp"
#include "support/reference_step.hpp"

namespace samara {
namespace {

using test::is_one_line;
using test::run_program_in;
using testing::HasSubstr;
using testing::StartsWith;

const std::string shapes = std::string(SAMARA_SOURCE_DIRECTORY) + "/meshes/shapes/";

std::string write_scene(const test::TemporaryFolder& folder, const std::string& shape,
                        const std::string& more = "") {
    std::ofstream(folder / "scene.toml") << fmt::format(
        "[scene]\nduration = 2.0\n[[body]]\nname = \"rubber\"\nshape = \"{}\"\ndensity = 1197.8\n"
        "orientation = [0.819, 0, -0.574, 0]\n{}\n",
        shape, more);
    return "scene.toml";
}

/// In a steady translation without rotation the runtime's loads and the Kirchhoff moment are the tabulated
/// CFD values.
void expect_steady_loads_reproduce_tables(const Body& body) {
    SceneBody flown;
    flown.name = "rubber";
    flown.mass.density = 1197.8;
    const ImmersedBody immersed = make_immersed_body(body, flown, Fluid{});
    const double reynolds = body.tables->reynolds_numbers.front();
    const double speed = reynolds * Fluid{}.kinematic_viscosity() / immersed.length;
    const double pressure = 0.5 * immersed.fluid_density * speed * speed * immersed.reference_area;
    for (const Vector3d& axis : {Vector3d(1, 0, 0), Vector3d(1, 1, 0), Vector3d(1, -2, 3)}) {
        const Vector3d direction = axis.normalized();
        Vector6d motion = Vector6d::Zero();
        motion.tail<3>() = speed * direction;
        Vector6d load = -load_matrix(immersed, motion) * motion;
        load.head<3>() += (immersed.added_mass * motion.tail<3>()).cross(motion.tail<3>());
        const LoadEntry entry = look_up(*body.tables, direction, reynolds);
        EXPECT_LT((load.tail<3>() - pressure * entry.force).norm(), 1e-12 * pressure);
        EXPECT_LT((load.head<3>() - pressure * immersed.length * entry.moment).norm(),
                  1e-12 * pressure * immersed.length);
    }
}

/// Runs words that must be refused: exit 1, one line that holds `expected`, and no output file.
void expect_rejection(const test::TemporaryFolder& folder, const std::vector<std::string>& words,
                      const std::string& expected) {
    const auto run = run_program_in(folder, words);
    EXPECT_EQ(run.status, 1) << run.error;
    EXPECT_TRUE(is_one_line(run.error)) << run.error;
    EXPECT_THAT(run.error, HasSubstr(expected));
    EXPECT_EQ(run.output, "");
    EXPECT_FALSE(std::filesystem::exists(folder / "out.h5"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out.body.h5"));
}

TEST(MainPath, AShapeIsMeshedOnceForAllRunsOfAScene) {
    const test::TemporaryFolder folder;
    write_scene(folder, shapes + "ellipsoid.geo");
    const auto flown = [&](const char* environment) {
        const auto run =
            run_program_in(folder, {"samara", "simulate", "scene.toml", "-o", "out.h5"}, environment);
        EXPECT_EQ(run.status, 0) << run.error;
        return file_content_hash(folder / "out.h5");
    };
    const std::string first = flown("SAMARA_CACHE=cache");
    // Where no temporary folder can be made nothing is meshed.
    EXPECT_EQ(flown("SAMARA_CACHE=cache TMPDIR=/nowhere"), first);
    EXPECT_EQ(flown("SAMARA_CACHE=off"), first);
    const auto off =
        run_program_in(folder, {"samara", "simulate", "scene.toml", "-o", "out.h5"}, "TMPDIR=/nowhere");
    EXPECT_EQ(off.status, 1);
}

TEST(MainPath, AShapeBecomesABakedBodyThatFallsAndLeavesForOtherTools) {
    const test::TemporaryFolder folder;
    write_scene(folder, shapes + "ellipsoid.geo");

    const auto bake = run_program_in(
        folder, {"samara", "bake", "scene.toml", "-o", "bodies", "--quality", "smoke", "--json"});
    ASSERT_EQ(bake.status, 0) << bake.error;
    const Body body = read_body_file(folder / "bodies/rubber.body.h5");
    ASSERT_TRUE(body.kirchhoff && body.tables);
    // Broadside drag on the broad face: the literature's disc has 1.17, bluff RANS on a coarse mesh up to
    // twice that.
    const double drag = -look_up(*body.tables, Vector3d::UnitX(), 1e4).force.x() * std::numbers::pi *
                        std::pow(body.tables->reference_length, 2) / 4.0 / (std::numbers::pi * 0.02 * 0.04);
    EXPECT_GT(drag, 0.6);
    EXPECT_LT(drag, 2.2);
    expect_steady_loads_reproduce_tables(body);

    const auto fall = run_program_in(
        folder, {"samara", "simulate", "scene.toml", "--bodies", "bodies", "-o", "fall.h5", "--json"});
    ASSERT_EQ(fall.status, 0) << fall.error;
    const nlohmann::json rubber = fall.json()["bodies"][0];
    EXPECT_EQ(rubber["name"], "rubber");
    EXPECT_GT(rubber["mean_descent_speed"].get<double>(), 0.1);
    EXPECT_LT(rubber["mean_descent_speed"].get<double>(), 0.35);
    EXPECT_THAT(rubber["models"].get<std::string>(), HasSubstr("by default"));

    const auto again =
        run_program_in(folder, {"samara", "simulate", "scene.toml", "--bodies", "bodies", "-o", "again.h5"});
    ASSERT_EQ(again.status, 0) << again.error;
    EXPECT_EQ(file_content_hash(folder / "fall.h5"), file_content_hash(folder / "again.h5"))
        << "same seed, same bytes";
    const auto other = run_program_in(
        folder, {"samara", "simulate", "scene.toml", "--bodies", "bodies", "--seed", "2", "-o", "other.h5"});
    ASSERT_EQ(other.status, 0) << other.error;
    EXPECT_NE(file_content_hash(folder / "fall.h5"), file_content_hash(folder / "other.h5"));

    write_scene(folder, shapes + "sphere.geo");
    const auto changed =
        run_program_in(folder, {"samara", "simulate", "scene.toml", "--bodies", "bodies", "-o", "x.h5"});
    EXPECT_EQ(changed.status, 1);
    EXPECT_THAT(changed.error, HasSubstr("bake the scene again"));

    for (const char* file : {"fall.glb", "fall.csv", "fall.usda", "fall.chan", "fall.html"}) {
        const auto written = run_program_in(folder, {"samara", "export", "fall.h5", "-o", file, "--json"});
        EXPECT_EQ(written.status, 0) << written.error;
    }
    EXPECT_THAT(read_bytes(folder / "fall.glb"), StartsWith("glTF"));
    EXPECT_THAT(read_bytes(folder / "fall.csv"), StartsWith("run,body,copy,time,position_x"));
    const auto picture = run_program_in(folder, {"samara", "plot", "fall.h5", "-o", "fall.png", "--json"});
    ASSERT_EQ(picture.status, 0) << picture.error;
    EXPECT_THAT(read_bytes(folder / "fall.png"), StartsWith("\x89PNG"));
    for (const char* file : {"fall.h5", "bodies/rubber.body.h5"}) {
        const auto info = run_program_in(folder, {"samara", "info", file, "--json"});
        EXPECT_EQ(info.status, 0) << info.error;
        EXPECT_TRUE(info.json().is_object());
    }
    const auto lookup =
        run_program_in(folder, {"samara", "info", "bodies/rubber.body.h5", "--direction", "1,0,0", "--json"});
    ASSERT_EQ(lookup.status, 0) << lookup.error;
    EXPECT_GT(lookup.json()["drag_coefficient"].get<double>(), 0.5);
    EXPECT_GT(lookup.json()["drag_coefficient_error"].get<double>(), 0.0);
    expect_rejection(folder, {"samara", "info", "bodies/rubber.body.h5", "--direction", "up"},
                     "not a direction");
}

TEST(MainPath, ARawShapeFliesWithCoefficientsAndWithoutABake) {
    const test::TemporaryFolder folder;
    write_scene(folder, shapes + "cube.geo", "loads = \"coefficients\"\ndrag_coefficient = 1.05");
    const auto fall = run_program_in(folder, {"samara", "simulate", "scene.toml", "-o", "fall.h5", "--json"});
    ASSERT_EQ(fall.status, 0) << fall.error;
    EXPECT_GT(fall.json()["bodies"][0]["mean_descent_speed"].get<double>(), 0.05);
}

TEST(BadInput, OfASceneIsNamedInOneLine) {
    const test::TemporaryFolder folder;
    const std::vector<std::string> words = {"samara", "simulate", "scene.toml", "-o", "out.h5"};
    expect_rejection(folder, words, "scene.toml");
    write_scene(folder, shapes + "cube.geo", "colour = 1");
    expect_rejection(folder, words, "scene.toml:8: unknown key 'colour'");
    write_scene(folder, "gone.stl");
    expect_rejection(folder, words, "gone.stl");
    std::ofstream(folder / "scene.toml") << "[scene]\nduration = 1\n[[body]]\nname = \"a\"\nshape = \""
                                         << shapes << "cube.geo\"\ndensity = -5\n";
    expect_rejection(folder, words, "scene.toml:6: density");
}

TEST(BadInput, ASceneWithTableLoadsAndNoTablesNamesTheBake) {
    const test::TemporaryFolder folder;
    write_scene(folder, shapes + "cube.geo", "loads = \"table\"");
    expect_rejection(folder, {"samara", "simulate", "scene.toml", "-o", "out.h5"}, "samara bake");
    expect_rejection(folder, {"samara", "simulate", "scene.toml", "--bodies", "none", "-o", "out.h5"},
                     "samara bake");
}

TEST(BadInput, InAnotherUnitGetsANoteThatNamesTheRemedy) {
    const test::TemporaryFolder folder;
    const auto note = [&](const std::vector<std::string>& words) {
        const auto done = run_program_in(folder, words);
        EXPECT_EQ(done.status, 0) << done.error;
        return done.error;
    };
    const std::string cube = shapes + "cube.geo";  // of 2 cm
    EXPECT_EQ(note({"samara", "mesh", cube, "-o", "cube.body.h5"}), "");
    EXPECT_EQ(
        note({"samara", "mesh", cube, "-o", "large.body.h5", "--scale", "1000"}),
        "samara mesh: warning: 'cube': 20 m long: if its shape is in millimetres, give --scale 0.001\n");
    const std::vector<std::string> bake = {"samara", "bake",      cube,        "-o",  "b.body.h5",
                                           "--json", "--dry-run", "--density", "2.7", "--scale"};
    const auto with_scale = [&](std::string scale) {
        std::vector<std::string> words = bake;
        words.push_back(std::move(scale));
        return words;
    };
    EXPECT_THAT(note(with_scale("1")), HasSubstr("if it is in g/cm^3, give 2700"));
    EXPECT_THAT(note(with_scale("1000")), HasSubstr("falls at a Reynolds number of about"));
    write_scene(folder, cube, "loads = \"coefficients\"\nscale = 1000");
    for (const std::string command : {"plan", "simulate"}) {
        std::vector<std::string> words = {"samara", command, "scene.toml"};
        if (command == "simulate") words.insert(words.end(), {"-o", "fall.h5"});
        EXPECT_THAT(note(words), HasSubstr("samara " + command + ": warning: 'rubber': 20 m long"));
        EXPECT_THAT(note(words), HasSubstr("write scale = 0.001 beside its shape"));
    }
}

TEST(BadInput, AShapeToPlanIsRefusedWithWhatToDo) {
    const test::TemporaryFolder folder;
    expect_rejection(folder, {"samara", "plan", shapes + "cube.geo"}, "--dry-run");
}

TEST(BadInput, ATruncatedOrForeignFileIsNamedInOneLine) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "text.body.h5") << "no HDF5 at all";
    expect_rejection(folder, {"samara", "info", "text.body.h5"}, "text.body.h5");
    expect_rejection(folder, {"samara", "plot", "text.body.h5", "-o", "out.png"}, "text.body.h5");
    expect_rejection(folder, {"samara", "export", "text.body.h5", "-o", "out.glb"}, "text.body.h5");
    expect_rejection(folder, {"samara", "convert", "nowhere", "-o", "out.body.h5"}, "nowhere");
    expect_rejection(folder, {"samara", "convert", "nowhere", "-o", "out.csv", "--fluctuations"},
                     "holds no unsteady case");
    expect_rejection(folder, {"samara", "convert", "nowhere", "-o", "out.body.h5", "--fluctuations"},
                     "name it NAME.csv");
    expect_rejection(folder, {"samara", "convert", "nowhere", "-o", "out.csv", "--from", "3"},
                     "--from: needs --fluctuations");
}

TEST(BadInput, AnUnknownCommandOrOptionIsNamedInOneLine) {
    const test::TemporaryFolder folder;
    expect_rejection(folder, {"samara", "fly"}, "unknown command 'fly'");
    expect_rejection(folder, {"samara", "simulate", "a.toml", "-o", "out.h5", "--fast"}, "--fast");
    expect_rejection(folder, {"samara", "simulate", "a.toml", "-o", "out.h5", "--step", "-1"}, "--step");
}

TEST(Help, OfEveryCommandWorks) {
    const test::TemporaryFolder folder;
    for (const char* command :
         {"mesh", "kirchhoff", "plan", "bake", "convert", "identify", "validate", "check-tables", "simulate",
          "export", "plot", "compare", "info", "report", "wind"}) {
        const auto help = run_program_in(folder, {"samara", command, "--help"});
        EXPECT_EQ(help.status, 0) << help.error;
        EXPECT_THAT(help.output, HasSubstr("--json")) << command;
        EXPECT_THAT(help.output, HasSubstr("Usage: samara " + std::string(command) + " ")) << command;
    }
}

}  // namespace
}  // namespace samara
