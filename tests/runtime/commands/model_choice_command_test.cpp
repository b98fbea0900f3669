// models = "auto" and the models' switches, through `samara simulate`.

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "samara/core/body/body_file.hpp"
#include "samara/motion/motion_file.hpp"
#include "support/hard_bodies.hpp"
#include "support/program_run.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using test::ProgramRun;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class ModelChoice : public ::testing::Test {
  protected:
    ModelChoice() {
        Body body = test::baked_ellipsoid({0.01, 0.02, 0.04});
        write_body_file(folder_ / "stone.body.h5", body);
        body.tables.reset();
        write_body_file(folder_ / "bare.body.h5", body);
        body.kirchhoff.reset();
        write_body_file(folder_ / "shape.body.h5", body);
    }
    [[nodiscard]] ProgramRun simulate(const std::string& keys, const std::string& output,
                                      const std::vector<std::string>& options = {},
                                      const std::string& body = "stone") const {
        (void)folder_.file("scene.toml",
                           "[scene]\nduration = 2\n[fluid]\npreset = \"air\"\n[[body]]\nname = \"stone\"\n"
                           "shape = \"" +
                               body + ".body.h5\"\ndensity = 2700\n" + keys + "\n");
        std::vector<std::string> words = {"samara", "simulate", "scene.toml", "-o", output};
        words.insert(words.end(), options.begin(), options.end());
        return run_program_in(folder_, words);
    }
    const test::TemporaryFolder folder_;
};

TEST_F(ModelChoice, OfAutoIsSaidAndIsTheSameMotionAsThoseModelsGiven) {
    const ProgramRun chosen = simulate("models = \"auto\"", "auto.h5", {"--json"});
    ASSERT_EQ(chosen.status, 0) << chosen.error;
    const nlohmann::json body = chosen.json()["models"]["bodies"][0];
    const nlohmann::json models = body["recommended"]["models"];
    EXPECT_EQ(body["name"], "stone");
    EXPECT_EQ(models["added_mass"], false);
    std::string keys;
    for (const auto& [key, value] : models.items()) keys += key + " = " + value.dump() + "\n";
    ASSERT_EQ(simulate(keys, "given.h5").status, 0) << keys;
    const Motion by_auto = read_motion_file(folder_ / "auto.h5");
    const Motion given = read_motion_file(folder_ / "given.h5");
    EXPECT_EQ(by_auto.bodies[0].poses.back().position, given.bodies[0].poses.back().position);
    EXPECT_THAT(by_auto.bodies[0].models,
                AllOf(HasSubstr("no added mass"), HasSubstr("chosen by models = \"auto\"")));
    EXPECT_THAT(given.bodies[0].models, AllOf(HasSubstr("no added mass"), Not(HasSubstr("auto"))));
}

TEST_F(ModelChoice, IsToldToPeopleAndIsNullWhereNothingIsChosen) {
    const ProgramRun told = simulate("models = \"auto\"", "motion.h5", {"--threads", "1"});
    EXPECT_THAT(told.output, AllOf(HasSubstr("models = \"auto\" chose:"), HasSubstr("recommended: ")));
    EXPECT_TRUE(simulate("", "motion.h5", {"--json"}).json()["models"].is_null());
}

TEST_F(ModelChoice, WithoutAddedMassNeedsNoTensor) {
    const ProgramRun run =
        simulate("loads = \"coefficients\"\nadded_mass = false", "motion.h5", {"--json"}, "shape");
    ASSERT_EQ(run.status, 0) << run.error;
    EXPECT_THAT(run.json()["bodies"][0]["models"].get<std::string>(), HasSubstr("no added mass"));
}

TEST_F(ModelChoice, OfAutoBesideAGivenModelIsRefusedWithItsLine) {
    const ProgramRun run = simulate("models = \"auto\"\nadded_mass = false", "motion.h5");
    EXPECT_EQ(run.status, 1);
    EXPECT_TRUE(test::is_one_line(run.error)) << run.error;
    EXPECT_THAT(run.error, HasSubstr("scene.toml:10: added_mass"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "motion.h5"));
}

TEST_F(ModelChoice, OfAutoWithoutTablesAsksForABake) {
    const ProgramRun run = simulate("models = \"auto\"", "motion.h5", {}, "bare");
    EXPECT_EQ(run.status, 1);
    EXPECT_TRUE(test::is_one_line(run.error)) << run.error;
    EXPECT_THAT(run.error, HasSubstr("samara bake"));
}

}  // namespace
}  // namespace samara
