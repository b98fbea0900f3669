#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "samara/commands/shared/load_body.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/hdf5_writer.hpp"
#include "samara/core/files/replace_file.hpp"
#include "support/expect_error.hpp"
#include "support/program_run.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

test::ProgramRun samara(const test::TemporaryFolder& folder, std::vector<std::string> words) {
    words.insert(words.begin(), "samara");
    return test::run_program_in(folder, words);
}

std::string write_ellipsoid(const test::TemporaryFolder& folder) {
    Body body;
    body.name = "egg";
    body.source = "made for a test";
    body.surface = test::ellipsoid({1.0, 2.0, 4.0}, 2, {0.5, -0.25, 1.0});
    body.moments = test::moments_of(body.surface);
    write_body_file(folder / "egg.body.h5", body);
    return (folder / "egg.body.h5").string();
}

TEST(KirchhoffCommand, PrintsOneJsonObject) {
    const test::TemporaryFolder folder;
    const test::ProgramRun outcome =
        samara(folder, {"kirchhoff", write_ellipsoid(folder), "--json", "--threads", "1"});
    ASSERT_EQ(outcome.status, 0) << outcome.error;
    const nlohmann::json result = outcome.json();
    EXPECT_NEAR(result["added_mass"][3][3].get<double>(), 50.87072167736, 0.03 * 50.87);  // Lamb, art. 114
    EXPECT_EQ(result["reference_point"], result["centroid"]);
    EXPECT_NEAR(result["centroid"][0].get<double>(), 0.5, 1e-12);
    EXPECT_GE(result["triangles"].get<int>(), 320);
    EXPECT_GT(result["error_estimate"].get<double>(), 0.0);
    for (const char* key : {"volume", "asymmetry", "method", "seconds"})
        EXPECT_TRUE(result.contains(key)) << key;
}

TEST(KirchhoffCommand, AboutAnotherPointCouplesRotationToTranslation) {
    const test::TemporaryFolder folder;
    const std::string file = write_ellipsoid(folder);
    const auto tensor = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"kirchhoff", file, "--json"};
        words.insert(words.end(), more.begin(), more.end());
        const test::ProgramRun outcome = samara(folder, words);
        EXPECT_EQ(outcome.status, 0) << outcome.error;
        return outcome.json();
    };
    const auto entry = [](const nlohmann::json& of, std::size_t row, std::size_t column) {
        return of["added_mass"][row][column].get<double>();
    };
    const nlohmann::json own = tensor({});
    const nlohmann::json result = tensor({"--about", "-0.5,-0.25,1"});
    // The centroid is 1 m along x from the point: v_centroid = v + omega_z y, so p_y of omega_z gains M_y.
    EXPECT_NEAR(entry(result, 4, 2), entry(own, 4, 2) + entry(own, 4, 4), 1e-12 * entry(own, 4, 4));
    EXPECT_EQ(result["reference_point"], nlohmann::json({-0.5, -0.25, 1.0}));
}

TEST(KirchhoffCommand, WritesTheTensorIntoTheBodyFileAndInfoShowsIt) {
    const test::TemporaryFolder folder;
    const std::string file = write_ellipsoid(folder);
    ASSERT_EQ(samara(folder, {"kirchhoff", file, "-o", file}).status, 0);
    const Body body = read_body_file(file);
    ASSERT_TRUE(body.kirchhoff.has_value());
    const test::ProgramRun outcome = samara(folder, {"info", file, "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.error;
    const nlohmann::json result = outcome.json();
    EXPECT_EQ(result["kirchhoff"]["added_mass"][5][5].get<double>(), body.kirchhoff->matrix(5, 5));
    EXPECT_NEAR(result["principal_extents"][2].get<double>(), 8.0, 0.1);
    EXPECT_TRUE(result["tables"].is_null());
}

TEST(KirchhoffCommand, WritesTheLoadsOfTheSurfaceByWhichABodyWithoutTablesFalls) {
    const test::TemporaryFolder folder;
    const std::string file = write_ellipsoid(folder);
    ASSERT_EQ(samara(folder, {"kirchhoff", file, "-o", file}).status, 0);
    ASSERT_TRUE(read_body_file(file).surface_loads.has_value());
    const auto flown = [&](const std::string& keys) {
        std::ofstream(folder / "fall.toml")
            << "[scene]\nduration = 20\nstep = 0.02\n[[body]]\nname = \"egg\"\nshape = \"egg.body.h5\"\n"
               "density = 1200\norientation = [0.95, 0, 0.31, 0]\n"
            << keys;
        return samara(folder, {"simulate", "fall.toml", "-o", "fall.h5", "--json"});
    };
    const test::ProgramRun by_default = flown("");
    ASSERT_EQ(by_default.status, 0) << by_default.error;
    EXPECT_THAT(by_default.error, HasSubstr("has no tables; its loads are estimated from"));
    EXPECT_THAT(by_default.json()["bodies"][0]["models"].get<std::string>(),
                StartsWith("loads surface; turbulence table (wake)"));
    const test::ProgramRun asked = flown("loads = \"surface\"\n");
    ASSERT_EQ(asked.status, 0) << asked.error;
    EXPECT_THAT(asked.error, Not(HasSubstr("has no tables")));
    EXPECT_EQ(asked.json()["bodies"][0]["final_position"], by_default.json()["bodies"][0]["final_position"]);
    const test::ProgramRun of_tables = flown("loads = \"table\"\n");
    EXPECT_EQ(of_tables.status, 1);
    EXPECT_THAT(of_tables.error, HasSubstr("holds no tables; make them with 'samara bake"));
}

TEST(KirchhoffCommand, ToleranceIsMetOrSaidToBeOutOfReach) {
    const test::TemporaryFolder folder;
    Body body;
    body.name = "egg";
    body.source = "made for a test";
    body.surface = test::curved_ellipsoid({1.0, 2.0, 4.0}, 3);
    body.moments = test::moments_of(body.surface);
    const std::string file = (folder / "egg.body.h5").string();
    write_body_file(file, body);

    const test::ProgramRun found = samara(folder, {"kirchhoff", file, "--json", "--tolerance", "1e-3"});
    ASSERT_EQ(found.status, 0) << found.error;
    EXPECT_LE(found.json()["error_estimate"].get<double>(), 1e-3);

    const test::ProgramRun missed = samara(folder, {"kirchhoff", file, "-o", file, "--tolerance", "1e-9"});
    EXPECT_EQ(missed.status, 1);
    EXPECT_TRUE(test::is_one_line(missed.error)) << missed.error;
    EXPECT_THAT(missed.error, HasSubstr("egg.body.h5: the tolerance 1e-09 cannot be reached"));
    EXPECT_FALSE(read_body_file(file).kirchhoff.has_value());
}

TEST(KirchhoffCommand, BadInputGivesOneLineThatNamesTheFile) {
    const test::TemporaryFolder folder;
    Body holed;
    holed.surface = test::icosphere(1);
    holed.moments = test::moments_of(holed.surface);
    holed.surface.corners.pop_back();
    write_body_file(folder / "holed.body.h5", holed);
    const std::string sound = write_ellipsoid(folder);
    const std::vector<std::vector<std::string>> bad = {
        {"kirchhoff", (folder / "nowhere.stl").string()},
        {"kirchhoff", (folder / "holed.body.h5").string()},
        {"kirchhoff", sound, "--triangles", "100"},
        {"kirchhoff", sound, "--about", "1,2"},
        {"kirchhoff", sound, "-o", (folder / "wrong.h5").string()},
    };
    for (const auto& words : bad) {
        const test::ProgramRun outcome = samara(folder, words);
        EXPECT_EQ(outcome.status, 1);
        EXPECT_THAT(outcome.error, StartsWith("samara kirchhoff: "));
        EXPECT_TRUE(test::is_one_line(outcome.error)) << outcome.error;
    }
    // So does a scene that needs the tensor.
    (void)folder.file("scene.toml",
                      "[scene]\nduration = 0.1\n[[body]]\nname = \"holed\"\nshape = \"holed.body.h5\"\n"
                      "density = 1200\nloads = \"none\"\n");
    EXPECT_THAT(samara(folder, {"simulate", "scene.toml", "-o", "motion.h5"}).error,
                HasSubstr("holed.body.h5: is not closed: 3 edges"));
    EXPECT_THAT(samara(folder, bad[1]).error, HasSubstr("holed.body.h5: is not closed: 3 edges"));
}

TEST(InfoCommand, ShowsTablesAndTheirProvenance) {
    const test::TemporaryFolder folder;
    write_body_file(folder / "a.body.h5", test::full_body());
    const test::ProgramRun outcome = samara(folder, {"info", (folder / "a.body.h5").string()});
    EXPECT_EQ(outcome.status, 0);
    for (const char* part : {"pebble", "10 200 3000", "18 (octahedron", "openfoam_version", "v1912", "0.5 m",
                             "m^3", "every rotation about"}) {
        EXPECT_THAT(outcome.output, HasSubstr(part));
    }
}

TEST(InfoCommand, ShowsDynamicCoefficientsWithTheirErrors) {
    const test::TemporaryFolder folder;
    const std::string file = (folder / "a.body.h5").string();
    Body body = test::full_body();
    write_body_file(file, body);
    const test::ProgramRun outcome = samara(folder, {"info", file});
    EXPECT_EQ(outcome.status, 0);
    for (const char* part :
         {"identified from 3 falls", "0.8 +- 0.06", "(0.05, 0.02, -0.006) +- (0.0004, 0.0004, 0.0004) m^3",
          "settling length", "1.3 +- 0.05", "(0.3, 0.2, 0.1) +- (0.007, 0.007, 0.007) m^2",
          "(0.01, 0.03, -0.02)"}) {
        EXPECT_THAT(outcome.output, HasSubstr(part));
    }
    const nlohmann::json result = samara(folder, {"info", file, "--json"}).json()["dynamic_coefficients"];
    EXPECT_EQ(result["rotational_transport"], 0.8);
    EXPECT_EQ(result["unsteady_factor"], 1.3);
    EXPECT_EQ(result["transport"][1][2], 0.001);
    EXPECT_EQ(result["drag_in_motion"][0][2], -0.02);
    EXPECT_EQ(result["standard_errors"]["rotational_drag"][1][1], 0.0008);
    body.dynamic.reset();
    write_body_file(file, body);
    EXPECT_TRUE(samara(folder, {"info", file, "--json"}).json()["dynamic_coefficients"].is_null());
    EXPECT_THAT(samara(folder, {"info", file}).output, HasSubstr("No dynamic coefficients"));
}

TEST(InfoCommand, ForeignHdf5GivesOneLine) {
    const test::TemporaryFolder folder;
    write_hdf5(folder / "a.h5", [](Hdf5Writer& file) {
        file.write("/density", std::vector<double>{1.0}, {1}, "kg/m^3", "of something");
    });
    const test::ProgramRun outcome = samara(folder, {"info", (folder / "a.h5").string()});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_THAT(outcome.error, HasSubstr("a.h5: is an HDF5 file, but not a body, motion"));
}

TEST(LoadBody, RefusesScaleAndTrianglesForABodyFile) {
    const test::TemporaryFolder folder;
    const std::string file = write_ellipsoid(folder);
    EXPECT_EQ(load_body(file).name, "egg");
    EXPECT_THAT(test::error_of([&] { load_body(file, {.scale = 0.001}); }), HasSubstr("already in metres"));
    EXPECT_THAT(test::error_of([&] { load_body(file, {.triangles = 500}); }),
                HasSubstr("already holds a mesh"));
    EXPECT_THAT(test::error_of([&] { load_body(folder.path()); }), HasSubstr("is a folder; give a file"));
}

}  // namespace
}  // namespace samara
