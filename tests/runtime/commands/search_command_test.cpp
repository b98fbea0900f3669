#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "samara/core/body/body_file.hpp"
#include "support/known_bodies.hpp"
#include "support/program_run.hpp"

namespace samara {
namespace {

using test::ProgramRun;
using testing::AllOf;
using testing::HasSubstr;

/// A folder with a ball that is thrown over the ground, without anything random.
class SearchCommand : public testing::Test {
  protected:
    SearchCommand() {
        write_body_file(folder_ / "ball.body.h5", test::exact_sphere(0.01));
        write_scene("");
    }
    void write_scene(const std::string& keys) const {
        std::ofstream(folder_ / "scene.toml")
            << "[scene]\nduration = 1.0\nground = -0.5\n[[body]]\nname = \"ball\"\nshape = "
               "\"ball.body.h5\"\nloads = \"none\"\ndensity = 2000\n"
            << keys;
    }
    [[nodiscard]] ProgramRun run(std::vector<std::string> words) const {
        words.insert(words.begin(), "samara");
        return run_program_in(folder_, words);
    }
    [[nodiscard]] ProgramRun search(std::vector<std::string> words) const {
        words.insert(words.begin(), {"search", "scene.toml", "--tries", "200", "--threads", "2"});
        return run(words);
    }

    test::TemporaryFolder folder_;
};

TEST_F(SearchCommand, PrintsValuesThatGiveTheSameMotionInTheScene) {
    write_scene("velocity = [1, 0, 0]\n");
    const std::vector<std::string> words = {"--target",
                                            "0.3,0.1,-0.49,0.05",
                                            "--speed",
                                            "0.2,2",
                                            "--direction-within",
                                            "60",
                                            "--orientation-within",
                                            "20",
                                            "--position-within",
                                            "0.05,0.05,0.05"};
    const ProgramRun told = search(words);
    ASSERT_EQ(told.status, 0) << told.error;
    const std::string values = told.output.substr(told.output.find("[scene]\n"));
    const std::string seed = values.substr(8, values.find('\n', 8) - 8);
    const std::string body = values.substr(values.find("name = \"ball\"\n") + 14);
    EXPECT_THAT(body,
                AllOf(HasSubstr("position = ["), HasSubstr("orientation = ["), HasSubstr("velocity = [")));
    std::vector<std::string> json_words = words;
    json_words.insert(json_words.end(), {"--json", "-o", "best.h5"});
    const ProgramRun found = search(json_words);
    ASSERT_EQ(found.status, 0) << found.error;
    const nlohmann::json best = found.json()["tries"][0];
    EXPECT_EQ(seed, "seed = " + best["seed"].dump());
    EXPECT_LE(best["score"], 1.0);

    write_scene(body);
    const ProgramRun again = run({"search", "scene.toml", "--target", "0.3,0.1,-0.49,0.05", "--tries", "1",
                                  "--json", "-o", "again.h5"});
    ASSERT_EQ(again.status, 0) << again.error;
    EXPECT_EQ(again.json()["tries"][0]["distance"], best["distance"]) << "to the last bit";
    const auto place = [&](const char* file) {
        return run({"info", file, "--json"}).json()["bodies"][0]["final_position"];
    };
    EXPECT_EQ(place("best.h5"), place("again.h5"));
}

TEST_F(SearchCommand, CombinesGoals) {
    write_scene("velocity = [1, 0, 0]\n");
    const std::vector<std::string> goals = {"--ring",
                                            "0.2,0,-0.2,1,0,0,0.1",
                                            "--landing-time",
                                            "0.5,0.1",
                                            "--up=-x",
                                            "--up-within",
                                            "40",
                                            "--speed",
                                            "0.1,1.5",
                                            "--orientation-within",
                                            "180",
                                            "--json"};
    const ProgramRun found = search(goals);
    ASSERT_EQ(found.status, 0) << found.error;
    const nlohmann::json best = found.json()["tries"][0];
    EXPECT_LE(best["ring_distance"], 0.1);
    EXPECT_LE(best["up_angle"], 0.7);
    EXPECT_NEAR(best["landing_time"].get<double>(), 0.5, 0.1);
    EXPECT_FALSE(best.contains("distance"));
    EXPECT_EQ(search(goals).output, found.output) << "the same seeds give the same";
}

TEST_F(SearchCommand, SaysWhatIsMissing) {
    const auto error = [&](const std::vector<std::string>& words) {
        const ProgramRun done = search(words);
        EXPECT_EQ(done.status, 1);
        EXPECT_TRUE(test::is_one_line(done.error)) << done.error;
        return done.error;
    };
    EXPECT_THAT(error({}), HasSubstr("give a goal: --target, --ring, --up or --landing-time"));
    EXPECT_THAT(error({"--up", "z"}), AllOf(HasSubstr("does not depend on the seed"), HasSubstr("--speed")));
    EXPECT_THAT(error({"--up", "w"}), HasSubstr("--up must be x, -x"));
    EXPECT_THAT(error({"--ring", "0,0,0"}), HasSubstr("x,y,z,radius in metres or x,y,z,nx,ny,nz,radius"));
    EXPECT_THAT(error({"--landing-time", "0.5,0"}), HasSubstr("tolerance 0 must be above 0"));
    EXPECT_THAT(error({"--up", "z", "--speed", "1,2"}),
                HasSubstr("give it one in the scene, such as velocity"));
    EXPECT_THAT(error({"--target", "9,0,0,0.1", "--position-within", "1,1,0"}),
                AllOf(HasSubstr("none of 200 tries reaches the goals"), HasSubstr("; distance ")));
}

}  // namespace
}  // namespace samara
