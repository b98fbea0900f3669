// Real meshes: what make_mesh.py does where the mesh as planned is not good.

#include <fstream>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bake_folder.hpp"
#include "foam-cases/farm/case_folder.hpp"
#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path foam_cases = fs::path(SAMARA_SOURCE_DIRECTORY) / "foam-cases";

class MeshMaking : public test::BakeFolder {
  protected:
    const fs::path mesh_ = cases_ / "mesh_coarse";

    void write_cases(const Body& body) const {
        write_case_folder(cases_, body, plan_bake(body, bake_quality("smoke"), 1e4), foam_cases);
    }
    void replace_parameter(const std::string& name, const std::string& value) const {
        const std::string before = read_bytes(mesh_ / "parameters");
        const std::string after =
            std::regex_replace(before, std::regex("\n" + name + " [^;]*;"), "\n" + name + " " + value + ";");
        ASSERT_NE(after, before);
        std::ofstream(mesh_ / "parameters") << after;
    }
    /// The exit status; what it prints is in the file output.
    [[nodiscard]] int make() const {
        return run_subprocess({"python3", "-B", (foam_cases / "farm/make_mesh.py").string(), mesh_.string()},
                              folder_ / "output");
    }
    [[nodiscard]] nlohmann::json record(const std::string& name) const {
        return nlohmann::json::parse(read_bytes(mesh_ / name));
    }
};

TEST_F(MeshMaking, TakesTheMeshAsPlannedWhereItIsGood) {
    write_cases(test::box_body({0.02, 0.02, 0.02}));
    ASSERT_EQ(make(), 0) << read_bytes(folder_ / "output");
    const nlohmann::json mesh = record("mesh.json");
    EXPECT_EQ(mesh["verdict"], "ok");
    EXPECT_EQ(mesh["remedy"], "as planned");
    EXPECT_EQ(mesh["attempts"].size(), 1u);
    EXPECT_NEAR(mesh["body_area_over_true_area"].get<double>(), 1.0, 0.01);
    EXPECT_FALSE(fs::exists(mesh_ / "remedy"));
}

// Cells far larger than the body do not see it at all.
TEST_F(MeshMaking, RefinesTheSurfaceWhereTheBodyWasMissed) {
    write_cases(test::sphere(0.01));
    replace_parameter("surfaceLevel", "2");
    replace_parameter("refinementShells", "((1 2) (3 1))");
    ASSERT_EQ(make(), 0) << read_bytes(folder_ / "output");
    const nlohmann::json mesh = record("mesh.json");
    EXPECT_NE(mesh["attempts"][0]["verdict"], "ok");
    EXPECT_THAT(mesh["attempts"][0]["verdict"].get<std::string>(), HasSubstr("of the body's surface"));
    EXPECT_THAT(mesh["remedy"].get<std::string>(), HasSubstr("surface level"));
    EXPECT_EQ(mesh["verdict"], "ok");
    EXPECT_NEAR(mesh["body_area_over_true_area"].get<double>(), 1.0, 0.08);

    // The same again gives the same bytes: nothing of the attempts before is left.
    const std::string points = read_bytes(mesh_ / "constant/polyMesh/points");
    ASSERT_EQ(make(), 0);
    EXPECT_EQ(read_bytes(mesh_ / "constant/polyMesh/points"), points);
    EXPECT_EQ(record("mesh.json")["attempts"], mesh["attempts"]);
}

TEST_F(MeshMaking, OfABodyThatNoRemedyFindsIsOneLineWithTheReasonAndWhatToDo) {
    write_cases(test::ellipsoid({0.0002, 0.0002, 0.006}));
    replace_parameter("surfaceLevel", "1");
    replace_parameter("refinementShells", "((3 1))");
    EXPECT_EQ(make(), 1);
    const std::string output = read_bytes(folder_ / "output");
    EXPECT_TRUE(test::is_one_line(output)) << output;
    EXPECT_THAT(output, HasSubstr("the body cannot be meshed"));
    EXPECT_THAT(output, HasSubstr("3 remedies did not help"));
    EXPECT_THAT(output, HasSubstr("use a finer --quality"));
    EXPECT_FALSE(fs::exists(mesh_ / "mesh.json"));
    EXPECT_THAT(output, HasSubstr(record("failed.json")["reason"].get<std::string>()));
}

TEST_F(MeshMaking, MeasuresTheSameAreaInAsciiAndBinaryFiles) {
    write_cases(test::sphere(0.01));
    ASSERT_EQ(make(), 0);
    const double binary = record("mesh.json")["body_area_over_true_area"].get<double>();
    const fs::path control = mesh_ / "system/controlDict";
    std::ofstream(control, std::ios::app) << "writeFormat ascii;\n";
    ASSERT_EQ(make(), 0);
    EXPECT_THAT(read_bytes(mesh_ / "constant/polyMesh/points"), HasSubstr("ascii"));
    EXPECT_NEAR(record("mesh.json")["body_area_over_true_area"].get<double>(), binary, 1e-9);
}

}  // namespace
}  // namespace samara
