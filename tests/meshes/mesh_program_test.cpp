// The program samara-mesh as its users run it.

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "meshes/shape_files.hpp"
#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

struct Outcome {
    int status = 0;
    std::string output;  // standard output and standard error together
};

Outcome run(const test::TemporaryFolder& folder, std::vector<std::string> words) {
    words.insert(words.begin(), SAMARA_PROGRAMS "/samara-mesh");
    const test::TemporaryFolder outside;
    const int status = run_subprocess(words, outside / "log", folder.path());
    return {status, read_bytes(outside / "log")};
}

TEST(MeshProgram, WritesABodyFileAndOneJsonObject) {
    const test::TemporaryFolder folder;
    const Outcome result =
        run(folder, {test::shape_of_samara("sheet.geo").string(), "-o", "sheet.body.h5", "--json"});
    ASSERT_EQ(result.status, 0) << result.output;
    const nlohmann::json json = nlohmann::json::parse(result.output);
    const Body body = read_body_file(folder / "sheet.body.h5");
    EXPECT_EQ(json.at("body"), "sheet.body.h5");
    EXPECT_EQ(json.at("triangles"), body.surface.triangle_count());
    EXPECT_EQ(json.at("vertices"), body.surface.vertices.size());
    EXPECT_EQ(json.at("order"), 1);
    EXPECT_EQ(json.at("volume"), body.moments.volume);
    EXPECT_EQ(json.at("surface_area"), body.moments.surface_area);
    EXPECT_EQ(json.at("centroid").size(), 3U);
    EXPECT_EQ(json.at("second_moments")[2][2], body.moments.second_moments(2, 2));
    EXPECT_EQ(json.at("symmetry").at("kind"), "finite");
    EXPECT_EQ(json.at("symmetry").at("elements"), 16);
    EXPECT_GT(json.at("seconds"), 0.0);
    EXPECT_EQ(folder.file_count(), 1);
}

TEST(MeshProgram, TellsPeopleWhatItMade) {
    const test::TemporaryFolder folder;
    const Outcome result =
        run(folder, {test::shape_of_samara("cube.geo").string(), "-o", "cube.body.h5", "--size", "0.004"});
    ASSERT_EQ(result.status, 0) << result.output;
    EXPECT_THAT(result.output, HasSubstr("cube.body.h5: "));
    EXPECT_THAT(result.output, HasSubstr("volume    8e-06 m^3"));
    EXPECT_THAT(result.output, HasSubstr("symmetry  48 rotations and reflections, 9 mirror planes"));
}

TEST(MeshProgram, AnswersBadInputWithOneLineAndNoFile) {
    const test::TemporaryFolder folder;
    Surface leaking = test::box(Vector3d::Ones(), 2);
    leaking.corners.pop_back();
    test::write_stl(folder / "leaking.stl", leaking);
    test::write_stl(folder / "box.stl", test::box(Vector3d::Ones(), 2));
    const std::vector<std::vector<std::string>> commands = {
        {"leaking.stl", "-o", "b.body.h5"},
        {"missing.stl", "-o", "b.body.h5"},
        {"box.stl", "-o", "b.h5"},
        {"box.stl", "-o", "nowhere/b.body.h5"},
        {"box.stl"},
        {"box.stl", "-o", "b.body.h5", "--triangles", "many"},
        {"box.stl", "-o", "b.body.h5", "--triangles", "0"},
        {"box.stl", "-o", "b.body.h5", "--triangles", "500", "--keep"},
        {"box.stl", "-o", "b.body.h5", "--order", "3"},
        {"box.stl", "-o", "b.body.h5", "--scale", "-1"},
        {"box.stl", "-o", "b.body.h5", "--flip"},
        {"box.stl", "-o", "b.body.h5", "--unknown"},
    };
    for (const std::vector<std::string>& words : commands) {
        const Outcome result = run(folder, words);
        EXPECT_EQ(result.status, 1) << result.output;
        EXPECT_THAT(result.output, StartsWith("samara mesh: "));
        EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
        EXPECT_EQ(folder.file_count(), 2) << result.output;
    }
}

TEST(MeshProgram, LeavesTheFileThatWasThereWhenItFails) {
    const test::TemporaryFolder folder;
    ASSERT_EQ(run(folder, {test::shape_of_samara("cube.geo").string(), "-o", "a.body.h5", "--keep"}).status,
              0);
    const std::string before = read_bytes(folder / "a.body.h5");
    EXPECT_EQ(run(folder, {"missing.geo", "-o", "a.body.h5"}).status, 1);
    EXPECT_EQ(read_bytes(folder / "a.body.h5"), before);
}

}  // namespace
}  // namespace samara
