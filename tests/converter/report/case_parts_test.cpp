#include "converter/report/case_parts.hpp"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "solved_folder.hpp"
#include "support/expect_error.hpp"

namespace samara {
namespace {

using test::SolvedFolder;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

LoadEntry along_the_motion(const Vector3d& direction, double reynolds_number) {
    LoadEntry entry;
    entry.force = -0.7 * direction;
    entry.moment = Vector3d(0.0, 0.0, 0.2);
    entry.turbulent_kinetic_energy = 0.01 * reynolds_number / 1e4;
    entry.dissipation_rate = 0.02;
    return entry;
}

/// Solved cases of a box, whose meshes hold nothing but the shell's cells.
class CaseParts : public testing::Test {
  protected:
    [[nodiscard]] CasesReport read() const {
        return read_cases_for_report(folder_.path(), folder_.body(), [](double) {});
    }
    SolvedFolder folder_{test::box_body({0.02, 0.04, 0.08}), 1, {1e4}, along_the_motion};
};

TEST_F(CaseParts, HoldTheHistoriesInTheTablesUnits) {
    const CasePlan plan = read_case_plan(folder_.path());
    const CaseHistory history = read_case_history(folder_.case_path(0), plan, plan.cases[0]);
    ASSERT_EQ(history.drag.size(), 20U);
    EXPECT_NEAR(history.drag.back(), 0.7, 0.02);
    EXPECT_NEAR(history.moment.back(), 0.2, 0.02);
    EXPECT_NEAR(history.k.back(), 0.01, 0.001);
    EXPECT_THAT(history.residuals, IsEmpty());
}

TEST_F(CaseParts, TakeResidualsOfThePressureFromTheSolversLog) {
    folder_.write(std::filesystem::path(folder_.names()[0]) / "log.simpleFoam",
                  "Time = 101\nsmoothSolver:  Solving for Ux, Initial residual = 0.5, Final\n"
                  "GAMG:  Solving for p, Initial residual = 0.002, Final residual = 1e-5\n"
                  "GAMG:  Solving for p, Initial residual = 0.001, Final residual = 1e-5\n"
                  "Time = 102\nGAMG:  Solving for p, Initial residual = 0.0015, Final residual = 1e-5\n");
    const CasePlan plan = read_case_plan(folder_.path());
    const CaseHistory history = read_case_history(folder_.case_path(0), plan, plan.cases[0]);
    EXPECT_THAT(history.residual_iterations, testing::ElementsAre(101.0, 102.0));
    EXPECT_THAT(history.residuals, testing::ElementsAre(0.002, 0.0015));
}

TEST_F(CaseParts, ShowWhatIsThereAndSayWhatIsNot) {
    const CasesReport report = read();
    ASSERT_EQ(report.parts.size(), 1U);
    EXPECT_EQ(report.parts[0].title, "Convergence of the cases");
    const nlohmann::json& picture = report.parts[0].blocks.at(0)["picture"];
    EXPECT_EQ(picture["picture"], "histories");
    EXPECT_EQ(picture["cases"].size(), folder_.names().size());
    EXPECT_THAT(report.missing, Contains(HasSubstr("constant/polyMesh/points")));
}

TEST_F(CaseParts, NameACaseThatFailedAndOneWhoseHistoryIsGone) {
    std::filesystem::remove(folder_.case_path(0) / "provenance.json");
    folder_.write(std::filesystem::path(folder_.names()[0]) / "failed.json",
                  "{\"reason\": \"diverged in all attempts\"}");
    std::filesystem::remove_all(folder_.case_path(1) / "postProcessing/forces");
    const CasesReport report = read();
    ASSERT_EQ(report.parts.size(), 1U);
    EXPECT_EQ(report.parts[0].blocks.at(1)["table"]["rows"][0][1], "diverged in all attempts");
    EXPECT_THAT(report.missing, Contains(HasSubstr(folder_.names()[1])));
}

TEST_F(CaseParts, OfAnotherBodyAreRejected) {
    const Body other = test::box_body({0.02, 0.04, 0.09});
    EXPECT_THAT(test::error_of([&] { read_cases_for_report(folder_.path(), other, [](double) {}); }),
                HasSubstr("holds the cases of another body"));
}

}  // namespace
}  // namespace samara
