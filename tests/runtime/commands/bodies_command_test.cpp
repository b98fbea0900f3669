#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paths.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/known_bodies.hpp"
#include "support/program_run.hpp"

namespace samara {
namespace {

using test::ProgramRun;
using testing::AllOf;
using testing::HasSubstr;

/// A folder that holds the body "pebble" with tables and an index that lists it and "twig".
class BodiesCommand : public testing::Test {
  protected:
    BodiesCommand() {
        Body body = test::rubber_ellipsoid();
        body.name = "pebble";
        body.source = "ellipsoid.geo (xxh128 0), by hand";
        body.tables = test::blunt_tables(body, 2);
        body.tables->quality = "preview";
        body.tables->error_sources = {{ErrorSource::mesh, 0.3, 0.1, 0.1, 0.1},
                                      {ErrorSource::interpolation, 0.4, 0.1, 0.1, 0.1}};
        write_body_file(folder_ / "pebble.body.h5", body);
        index(
            "body = [{ name = \"pebble\", shape = \"ellipsoid.geo\", fluid = \"water\", density = 1200, "
            "quality = \"preview\", purpose = \"pebbles\" },\n{ name = \"twig\", shape = \"twig.geo\" }]\n");
    }
    void index(const std::string& text) { std::ofstream(folder_ / "bodies.toml") << text; }
    [[nodiscard]] ProgramRun run(std::vector<std::string> words,
                                 const std::string& environment = "SAMARA_BODIES=.") const {
        words.insert(words.begin(), "samara");
        return run_program_in(folder_, words, environment);
    }
    void expect_rejection(const std::vector<std::string>& words, const std::string& text) const {
        const ProgramRun done = run(words);
        EXPECT_EQ(done.status, 1);
        EXPECT_TRUE(test::is_one_line(done.error)) << done.error;
        EXPECT_THAT(done.error, HasSubstr(text));
    }
    void write_scene(const std::string& shape) {
        std::ofstream(folder_ / "scene.toml")
            << "[scene]\nduration = 0.1\n[[body]]\nname = \"stone\"\nshape = \"" << shape
            << "\"\ndensity = 1200\n";
    }

    test::TemporaryFolder folder_;
};

// The figures of docs/how-to/judge-a-bake.md: Brown and Lawler (2003), Hoerner (1965).
TEST_F(BodiesCommand, ThoseThatComeWithSamaraHaveTheDragOfTheLiteratureWithinAFifth) {
    const std::string ready = std::string(SAMARA_SOURCE_DIRECTORY) + "/runtime/bodies/";
    const auto drag = [&](const std::string& name, const char* reynolds_number) {
        const nlohmann::json entry = run({"info", ready + name + ".body.h5", "--direction", "0,0,1",
                                          "--reynolds-number", reynolds_number, "--json"})
                                         .json();
        return entry["drag_coefficient_on_projected_area"].get<double>();
    };
    EXPECT_NEAR(drag("sphere", "3770"), 0.44, 0.005);
    EXPECT_NEAR(drag("sphere", "11300"), 0.41, 0.005);
    EXPECT_NEAR(drag("sphere", "37700"), 0.39, 0.005);
    EXPECT_NEAR(drag("sphere", "113000"), 0.38, 0.005);
    EXPECT_NEAR(drag("sphere", "113000"), 0.466, 0.2 * 0.466);
    EXPECT_NEAR(drag("cube", "17600"), 1.05, 0.05 * 1.05);
    EXPECT_NEAR(drag("disc", "16500"), 1.17, 0.05 * 1.17);
}

TEST_F(BodiesCommand, ListsShapeSizeFluidReynoldsNumbersQualityErrorAndPurpose) {
    const ProgramRun text = run({"bodies"});
    ASSERT_EQ(text.status, 0) << text.error;
    EXPECT_THAT(text.output,
                AllOf(HasSubstr("pebble"), HasSubstr("20 x 40 x 80"), HasSubstr("1e+03 1e+05"),
                      HasSubstr("50 %"), HasSubstr("pebbles"), HasSubstr("Not baked yet: twig")));
    const nlohmann::json json = run({"bodies", "--json"}).json();
    ASSERT_EQ(json["bodies"].size(), 1U);
    const nlohmann::json& body = json["bodies"][0];
    EXPECT_EQ(body["name"], "pebble");
    EXPECT_EQ(body["shape"], "ellipsoid.geo");
    EXPECT_EQ(body["fluid"], "water");
    EXPECT_EQ(body["density"], 1200.0);
    EXPECT_EQ(body["quality"], "preview");
    EXPECT_NEAR(body["force_error"].get<double>(), 0.5, 1e-12);
    EXPECT_NEAR(body["extents"][2].get<double>(), 0.08, 1e-12);
    EXPECT_EQ(body["hash"], file_content_hash(folder_ / "pebble.body.h5"));
    EXPECT_EQ(json["not_baked"], nlohmann::json({"twig"}));
}

TEST_F(BodiesCommand, ListsBodyFilesThatTheIndexDoesNotKnow) {
    std::filesystem::remove(folder_ / "bodies.toml");
    const nlohmann::json json = run({"bodies", "--json"}).json();
    EXPECT_EQ(json["bodies"][0]["name"], "pebble");
    EXPECT_TRUE(json["bodies"][0]["fluid"].is_null());
    EXPECT_EQ(run({"bodies"}).status, 0);
}

TEST_F(BodiesCommand, CopiesOneByteForByte) {
    const ProgramRun done = run({"bodies", "pebble", "-o", "mine.body.h5", "--json"});
    ASSERT_EQ(done.status, 0) << done.error;
    EXPECT_EQ(done.json()["output"], "mine.body.h5");
    EXPECT_EQ(read_bytes(folder_ / "mine.body.h5"), read_bytes(folder_ / "pebble.body.h5"));
}

TEST_F(BodiesCommand, ShowsWhatTheFileOfOneHolds) {
    const ProgramRun done = run({"bodies", "pebble"});
    EXPECT_EQ(done.status, 0) << done.error;
    EXPECT_THAT(done.output, AllOf(HasSubstr("Body pebble"), HasSubstr("Reynolds numbers")));
}

TEST_F(BodiesCommand, RefusesBodiesAndFoldersThatAreNotThereInOneLine) {
    expect_rejection({"bodies", "stone"}, "there is no ready-baked body 'stone'");
    expect_rejection({"bodies", "twig", "-o", "twig.body.h5"}, "choose one of pebble");
    expect_rejection({"bodies", "pebble", "-o", "pebble.h5"}, "name it NAME.body.h5");
    expect_rejection({"bodies", "-o", "pebble.body.h5"}, "-o copies one body; name it");
    const ProgramRun done = run({"bodies"}, "SAMARA_BODIES=nowhere");
    EXPECT_EQ(done.status, 1);
    EXPECT_THAT(done.error, HasSubstr("SAMARA_BODIES names nowhere, which is not a folder"));
    index("body = [\n{ name = \"pebble\", colour = \"red\" }]\n");
    expect_rejection({"bodies"}, "bodies.toml:2: ");
}

TEST_F(BodiesCommand, ScenesFlyReadyBodiesByName) {
    write_scene("samara:pebble");
    const ProgramRun done = run({"simulate", "scene.toml", "-o", "motion.h5"});
    ASSERT_EQ(done.status, 0) << done.error;
    EXPECT_TRUE(std::filesystem::exists(folder_ / "motion.h5"));
    write_scene("pebble.body.h5");
    ASSERT_EQ(run({"simulate", "scene.toml", "-o", "same.h5"}).status, 0);
    const auto bodies = [&](const char* file) { return run({"info", file, "--json"}).json()["bodies"]; };
    EXPECT_EQ(bodies("motion.h5"), bodies("same.h5"));
}

TEST_F(BodiesCommand, ScenesThatNameNoReadyBodyAreRefusedWithTheirLine) {
    write_scene("samara:twig");
    expect_rejection({"simulate", "scene.toml", "-o", "motion.h5"}, "scene.toml:5: shape in [[body]] ");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "motion.h5"));
}

TEST(ReadyBodies, OfTheProjectCanAllBeReadAndSayWhatTheyAreFor) {
    const test::TemporaryFolder folder;
    const ProgramRun done = run_program_in(folder, {"samara", "bodies", "--json"});
    ASSERT_EQ(done.status, 0) << done.error;
    ASSERT_FALSE(done.json()["bodies"].empty());
    for (const nlohmann::json& body : done.json()["bodies"]) {
        EXPECT_EQ(body["shape"], body["name"].get<std::string>() + ".geo");
        EXPECT_TRUE(body["force_error"].is_number()) << body["name"];
        EXPECT_TRUE(body["purpose"].is_string()) << body["name"];
        EXPECT_TRUE(body["source"].get<std::string>().find(file_content_hash(
                        SAMARA_SOURCE_DIRECTORY "/meshes/shapes/" + body["shape"].get<std::string>())) !=
                    std::string::npos)
            << body["name"] << " was baked from another shape than meshes/ holds: run ./dev bodies";
        EXPECT_LT(std::filesystem::file_size(body["file"].get<std::string>()), 400'000U);
    }
}

}  // namespace
}  // namespace samara
