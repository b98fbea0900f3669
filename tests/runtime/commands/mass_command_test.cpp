#include <fstream>
#include <string>
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

/// A folder with the body file of a rubber ellipsoid of 1:2:4 cm, which says nothing of its mass.
class MassCommand : public testing::Test {
  protected:
    MassCommand() {
        Body body = test::rubber_ellipsoid();
        body.tables = test::blunt_tables(body, 2);
        write_body_file(folder_ / "egg.body.h5", body);
    }
    [[nodiscard]] ProgramRun run(std::vector<std::string> words) const {
        words.insert(words.begin(), "samara");
        return run_program_in(folder_, words);
    }
    [[nodiscard]] std::string hash_of_simulation(const std::string& keys) const {
        std::ofstream(folder_ / "scene.toml")
            << "[scene]\nduration = 0.2\n[[body]]\nname = \"egg\"\nshape = \"egg.body.h5\"\n"
            << keys;
        const ProgramRun done = run({"simulate", "scene.toml", "-o", "motion.h5"});
        EXPECT_EQ(done.status, 0) << done.error;
        const ProgramRun info = run({"info", "motion.h5", "--json"});
        return info.json()["bodies"][0]["mean_velocity"].dump();
    }

    test::TemporaryFolder folder_;
};

TEST_F(MassCommand, ScenesFlyABodyThatSaysWhatItWeighsAsIfTheySaidIt) {
    const std::string said = hash_of_simulation("density = 1300\n");
    ASSERT_EQ(run({"mass", "egg.body.h5", "--density", "1300"}).status, 0);
    EXPECT_EQ(hash_of_simulation(""), said);
    EXPECT_NE(hash_of_simulation("density = 1400\n"), said);
}

TEST_F(MassCommand, PartsGiveMassCentreAndInertia) {
    const ProgramRun done =
        run({"mass", "egg.body.h5", "--mass", "0.05", "--center-of-mass", "0.001,0,-0.002", "--inertia",
             "3e-6,4e-6,5e-6", "-o", "parts.body.h5", "--json"});
    ASSERT_EQ(done.status, 0) << done.error;
    EXPECT_EQ(done.json()["mass"], 0.05);
    EXPECT_EQ(done.json()["density"], nullptr);
    EXPECT_EQ(done.json()["center_of_mass"], (nlohmann::json{0.001, 0.0, -0.002}));
    EXPECT_EQ(done.json()["inertia"][2][2], 5e-6);
    EXPECT_FALSE(read_body_file(folder_ / "egg.body.h5").mass);
    const ProgramRun info = run({"info", "parts.body.h5"});
    EXPECT_THAT(info.output, HasSubstr("0.05 kg"));
    EXPECT_THAT(info.output, HasSubstr("(0.001, 0, -0.002) m"));
    EXPECT_EQ(run({"info", "parts.body.h5", "--json"}).json()["mass"]["mass"], 0.05);
    EXPECT_EQ(run({"info", "egg.body.h5", "--json"}).json()["mass"], nullptr);
}

TEST_F(MassCommand, RefusesWhatIsNoMassInOneLineAndLeavesTheFile) {
    const std::string before = file_content_hash(folder_ / "egg.body.h5");
    const std::vector<std::pair<std::vector<std::string>, const char*>> cases = {
        {{}, "--density, --mass or --area-density"},
        {{"--density", "1", "--mass", "1"}, "give one of them"},
        {{"--area-density", "80", "--mass", "1"}, "give one of them"},
        {{"--density", "1200", "--center-of-mass", "0,0,0"}, "contradicts a uniform density"},
        {{"--mass", "0.05", "--center-of-mass", "0,0"}, "not a vector"},
        {{"--mass", "0.05", "--center-of-mass", "0,0,0.5"}, "within the box of the shape"},
        {{"--mass", "0.05", "--inertia", "1,1,3"}, "at most the sum of the others"},
        {{"--mass", "0.05", "-o", "egg.h5"}, ".body.h5"},
    };
    for (const auto& [words, text] : cases) {
        std::vector<std::string> all = {"mass", "egg.body.h5"};
        all.insert(all.end(), words.begin(), words.end());
        const ProgramRun done = run(all);
        EXPECT_NE(done.status, 0) << text;
        EXPECT_TRUE(test::is_one_line(done.error)) << done.error;
        EXPECT_THAT(done.error, HasSubstr(text));
    }
    EXPECT_EQ(file_content_hash(folder_ / "egg.body.h5"), before);
}

TEST_F(MassCommand, ABodyFileWithoutAMassNeedsOneInTheScene) {
    std::ofstream(folder_ / "scene.toml")
        << "[scene]\nduration = 0.2\n[[body]]\nname = \"egg\"\nshape = \"egg.body.h5\"\n";
    const ProgramRun done = run({"simulate", "scene.toml", "-o", "motion.h5"});
    EXPECT_EQ(done.status, 1);
    EXPECT_TRUE(test::is_one_line(done.error)) << done.error;
    EXPECT_THAT(done.error, HasSubstr("'egg'"));
    EXPECT_THAT(done.error, HasSubstr("give density, mass or area_density"));
}

}  // namespace
}  // namespace samara
