#include <algorithm>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/known_bodies.hpp"
#include "support/program_run.hpp"

namespace samara {
namespace {

using test::ProgramRun;
using testing::HasSubstr;
using testing::StartsWith;

/// A folder with the body file of a rubber ellipsoid of 1:2:4 cm with tables and loads of its surface, and
/// the scene of its fall.
class RecommendCommand : public testing::Test {
  protected:
    RecommendCommand() {
        Body body = test::rubber_ellipsoid();
        body.tables = test::blunt_tables(body, 2);
        write_body_file(folder_ / "egg.body.h5", body);
        EXPECT_EQ(run({"kirchhoff", "egg.body.h5", "-o", "egg.body.h5"}).status, 0);
    }
    [[nodiscard]] ProgramRun run(std::vector<std::string> words) const {
        words.insert(words.begin(), "samara");
        return run_program_in(folder_, words);
    }
    /// Simulates the fall with these keys of the body.
    [[nodiscard]] ProgramRun simulate(const std::string& keys, const std::string& motion) const {
        std::ofstream(folder_ / "fall.toml")
            << "[scene]\nduration = 2\n[[body]]\nname = \"egg\"\nshape = \"egg.body.h5\"\n"
               "density = 1200\norientation = [0.95, 0, 0.31, 0]\n"
            << keys;
        return run({"simulate", "fall.toml", "-o", motion, "--json"});
    }

    test::TemporaryFolder folder_;
};

TEST_F(RecommendCommand, FindsTheModelsThatAFallWasMadeBy) {
    ASSERT_EQ(simulate("loads = \"surface\"\npatches = 2\nturbulence = \"none\"\n", "reference.h5").status,
              0);
    ASSERT_EQ(simulate("", "by_table.h5").status, 0);
    const ProgramRun judged =
        run({"recommend", "egg.body.h5", "--falls", "fall.toml,reference.h5", "--json"});
    ASSERT_EQ(judged.status, 0) << judged.error;
    EXPECT_EQ(judged.json()["loads"], "surface");
    EXPECT_EQ(judged.json()["patches"], 2);
    EXPECT_THAT(judged.json()["origin"].get<std::string>(), StartsWith("judged by 1 fall: off by 0 %"));
    // Now a scene that says nothing flies it so.
    const ProgramRun now = simulate("", "now.h5");
    ASSERT_EQ(now.status, 0) << now.error;
    EXPECT_THAT(now.json()["bodies"][0]["models"].get<std::string>(),
                StartsWith("loads surface; turbulence table (wake); in 2 patches"));
    EXPECT_EQ(now.error, "");
    const ProgramRun text = run({"recommend", "egg.body.h5", "--falls", "fall.toml,by_table.h5"});
    EXPECT_THAT(text.output, HasSubstr("off by 0 %, recommended"));
    EXPECT_EQ(read_body_file(folder_ / "egg.body.h5").recommended->loads, Loads::table);
}

TEST_F(RecommendCommand, TakesModelsAsTheyAreGiven) {
    const ProgramRun given = run({"recommend", "egg.body.h5", "--loads", "table", "--patches", "4",
                                  "--turbulence", "none", "-o", "other.body.h5", "--json"});
    ASSERT_EQ(given.status, 0) << given.error;
    const RecommendedModels expected = {.patches = 4, .turbulence = Turbulence::none, .origin = "given"};
    EXPECT_EQ(read_body_file(folder_ / "other.body.h5").recommended, expected);
    EXPECT_FALSE(read_body_file(folder_ / "egg.body.h5").recommended);
    EXPECT_THAT(run({"info", "other.body.h5"}).output, HasSubstr("loads table, 4 patches, turbulence none"));
    EXPECT_EQ(run({"info", "other.body.h5", "--json"}).json()["recommended"]["patches"], 4);
}

TEST_F(RecommendCommand, RejectsWhatItCannotJudgeInOneLineAndLeavesTheFile) {
    ASSERT_EQ(simulate("", "fall.h5").status, 0);
    std::ofstream(folder_ / "two.toml")
        << "[scene]\nduration = 2\n[[body]]\nname = \"a\"\nshape = \"egg.body.h5\"\ndensity = 1200\n"
           "[[body]]\nname = \"b\"\nshape = \"egg.body.h5\"\ndensity = 1200\n";
    const std::string before = file_content_hash(folder_ / "egg.body.h5");
    const std::vector<std::pair<std::vector<std::string>, const char*>> cases = {
        {{}, "either --loads or --falls"},
        {{"--loads", "table", "--falls", "fall.toml,fall.h5"}, "either --loads or --falls"},
        {{"--falls", "fall.toml,fall.h5", "--patches", "2"}, "leave out --patches"},
        {{"--falls", "fall.toml"}, "pairs of a scene and its reference"},
        {{"--falls", "two.toml,fall.h5"}, "two.toml: has no body 'egg'"},
        {{"--falls", "fall.toml,none.h5"}, "none.h5"},
        {{"--loads", "table", "-o", "egg.h5"}, ".body.h5"},
    };
    for (const auto& [words, text] : cases) {
        std::vector<std::string> all = {"recommend", "egg.body.h5"};
        all.insert(all.end(), words.begin(), words.end());
        const ProgramRun done = run(all);
        EXPECT_NE(done.status, 0);
        EXPECT_THAT(done.error, HasSubstr(text));
        EXPECT_EQ(std::count(done.error.begin(), done.error.end(), '\n'), 1) << done.error;
    }
    EXPECT_EQ(file_content_hash(folder_ / "egg.body.h5"), before);
}

}  // namespace
}  // namespace samara
