// Real OpenFOAM runs at smoke quality, through the program as a user calls it.

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "bake_folder.hpp"
#include "foam-cases/farm/case_farm.hpp"
#include "foam-cases/farm/case_folder.hpp"
#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const fs::path foam_cases = fs::path(SAMARA_SOURCE_DIRECTORY) / "foam-cases";

class Bake : public test::BakeFolder {};

TEST_F(Bake, OfAnEllipsoidGivesTablesAndReusesThemWhenRunAgain) {
    const fs::path file = write_body(test::ellipsoid({0.01, 0.02, 0.04}));
    const test::ProgramRun first =
        bake(fmt::format("{} -o out.body.h5 --quality smoke --json", file.string()));
    ASSERT_EQ(first.status, 0) << first.error;
    const nlohmann::json json = first.json();
    ASSERT_EQ(json["cases"].size(), 6u);
    EXPECT_EQ(json["reused_cases"], 0);
    EXPECT_EQ(json["meshes"][0]["verdict"], "ok");
    EXPECT_GT(json["cases"][0]["cpu_seconds"].get<double>(), 0.1);
    double accounted = 0.0;
    for (const nlohmann::json& part : json["cpu_account"]) accounted += part["cpu_seconds"].get<double>();
    EXPECT_EQ(json["cpu_account"][0]["part"], "surface");
    EXPECT_EQ(json["cpu_account"][3]["part"], "cases on mesh_coarse");
    EXPECT_EQ(json["cpu_account"][3]["count"], 6);
    EXPECT_GT(accounted, json["cpu_seconds"].get<double>());

    // Broadside first, end-on third, after the middle axis. A fine solution has 1.30 and 0.09 on the area pi
    // L^2 / 4; the smoke mesh is coarse. Disks and prolate spheroids (Hoerner 1965) bracket these.
    EXPECT_EQ(json["cases"][0]["direction"], nlohmann::json({1.0, 0.0, 0.0}));
    EXPECT_NEAR(json["cases"][0]["drag_coefficient"].get<double>(), 1.45, 0.35);
    EXPECT_EQ(json["cases"][2]["direction"], nlohmann::json({0.0, 0.0, 1.0}));
    EXPECT_NEAR(json["cases"][2]["drag_coefficient"].get<double>(), 0.09, 0.04);

    const Body body = read_body_file(output_);
    ASSERT_TRUE(body.tables.has_value());
    EXPECT_TRUE(body.kirchhoff.has_value());
    EXPECT_EQ(body.tables->quality, "smoke");
    const Vector3d force = look_up(*body.tables, Vector3d::UnitX(), 1e4).force;
    EXPECT_LT(force.x(), 0.0);
    EXPECT_NEAR(-force.x(), json["cases"][0]["drag_coefficient"].get<double>(), 1e-9);

    const auto before = solved();
    const test::ProgramRun second =
        bake(fmt::format("{} -o out.body.h5 --quality smoke --json", file.string()));
    ASSERT_EQ(second.status, 0) << second.error;
    EXPECT_EQ(second.json()["reused_cases"], 6);
    EXPECT_EQ(solved(), before);
}

TEST_F(Bake, TakesLoadsFromOneModelAndTurbulenceFromAnotherWhereToldTo) {
    const fs::path file = write_body(test::sphere(0.01));
    const test::ProgramRun run =
        bake(fmt::format("{} -o out.body.h5 --quality smoke --loads kOmegaSSTLM --json", file.string()));
    ASSERT_EQ(run.status, 0) << run.error;
    const nlohmann::json json = run.json();
    ASSERT_EQ(json["cases"].size(), 1u);
    // A resolved boundary layer on the coarse mesh: near what was measured (docs/studies/closures); k-epsilon
    // has 0.3.
    EXPECT_NEAR(json["cases"][0]["drag_coefficient"].get<double>(), 0.43, 0.08);
    const fs::path cases = output_.parent_path() / "out.cases";
    const auto closure_in = [&](const std::string& name) {
        return nlohmann::json::parse(read_bytes(cases / name / "provenance.json"))["closure"];
    };
    EXPECT_EQ(closure_in("direction_00_coarse"), "kOmegaSSTLM");
    EXPECT_EQ(closure_in("direction_00_coarse_turbulence"), "kEpsilon");
    const Body body = read_body_file(output_);
    EXPECT_GT(look_up(*body.tables, Vector3d::UnitX(), 1e4).turbulent_kinetic_energy, 0.0);
}

TEST_F(Bake, OfKAndEpsilonAloneKeepsAllElseOfABakedBody) {
    const fs::path file = write_body(test::sphere(0.01));
    ASSERT_EQ(bake(fmt::format("{} -o first.body.h5 --quality smoke", file.string())).status, 0);
    const test::ProgramRun run =
        bake("first.body.h5 -o out.body.h5 --turbulence-only --closure realizableKE --json");
    ASSERT_EQ(run.status, 0) << run.error;
    const Body first = read_body_file(folder_ / "first.body.h5");
    const Body second = read_body_file(output_);
    EXPECT_EQ(second.tables->quality, "smoke");
    EXPECT_EQ(second.kirchhoff->matrix, first.kirchhoff->matrix);
    EXPECT_EQ(run.json()["reynolds_numbers"][0], first.tables->reynolds_numbers[0]);
    const double reynolds_number = first.tables->reynolds_numbers[0];
    const LoadEntry before = look_up(*first.tables, Vector3d::UnitX(), reynolds_number);
    const LoadEntry after = look_up(*second.tables, Vector3d::UnitX(), reynolds_number);
    EXPECT_EQ(after.force, before.force);
    EXPECT_GT(after.turbulent_kinetic_energy, 0.0);
    EXPECT_NE(after.turbulent_kinetic_energy, before.turbulent_kinetic_energy);
    const nlohmann::json solved = run.json()["cases"][0];
    EXPECT_NEAR(after.turbulent_kinetic_energy, solved["turbulent_kinetic_energy"].get<double>(), 1e-9);
    const fs::path record = folder_ / "out.turbulence.cases/direction_00_coarse/provenance.json";
    EXPECT_EQ(nlohmann::json::parse(read_bytes(record))["closure"], "realizableKE");
    // Under its own name, and again: the cases are reused, and the body is the same.
    const std::string data = data_of(output_);
    const test::ProgramRun again =
        bake("out.body.h5 -o out.body.h5 --turbulence-only --closure realizableKE --json");
    ASSERT_EQ(again.status, 0) << again.error;
    EXPECT_EQ(again.json()["reused_cases"], 1);
    EXPECT_EQ(data_of(output_), data);
}

TEST_F(Bake, OfKAndEpsilonAloneNeedsTables) {
    const fs::path file = write_body(test::sphere(0.01));
    const test::ProgramRun run = bake(fmt::format("{} -o out.body.h5 --turbulence-only", file.string()));
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.error, HasSubstr("has no tables whose k and epsilon could be replaced"));
}

TEST_F(Bake, EstimatesTheCellsOfTheMeshThatIsMade) {
    const fs::path file = write_body(test::sphere(0.01));
    const test::ProgramRun estimate =
        bake(fmt::format("{} -o out.body.h5 --quality smoke --dry-run --json", file.string()));
    ASSERT_EQ(estimate.status, 0) << estimate.error;
    const test::ProgramRun made =
        bake(fmt::format("{} -o out.body.h5 --quality smoke --json", file.string()));
    ASSERT_EQ(made.status, 0) << made.error;
    const double cells = made.json()["meshes"][0]["cells"].get<double>();
    EXPECT_NEAR(estimate.json()["estimated_cells"][0].get<double>(), cells, 0.2 * cells);
    EXPECT_NEAR(made.json()["meshes"][0]["body_area_over_true_area"].get<double>(), 1.0, 0.05);
}

TEST_F(Bake, OfASheetOfATenthOfAPercentKeepsItsRim) {
    const fs::path file = write_body(test::box_body({0.1, 0.1, 0.00012}));
    const test::ProgramRun made =
        bake(fmt::format("{} -o out.body.h5 --quality smoke --json", file.string()));
    ASSERT_EQ(made.status, 0) << made.error;
    EXPECT_NEAR(made.json()["meshes"][0]["body_area_over_true_area"].get<double>(), 1.0, 0.05);
}

TEST_F(Bake, ThatIsKilledLeavesNoSolverBehindAndGoesOnWhereItStopped) {
    const fs::path file = write_body(test::ellipsoid({0.01, 0.02, 0.04}));
    const pid_t child = start_until_first_case(file);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    const auto after_kill = solved();
    ASSERT_FALSE(after_kill.empty());
    ASSERT_LT(after_kill.size(), 6u);
    std::this_thread::sleep_for(std::chrono::seconds(2));
    EXPECT_EQ(solved(), after_kill);
    EXPECT_FALSE(fs::exists(output_));

    const test::ProgramRun again =
        bake(fmt::format("{} -o out.body.h5 --quality smoke --json", file.string()));
    ASSERT_EQ(again.status, 0) << again.error;
    EXPECT_EQ(again.json()["reused_cases"], after_kill.size());
    for (const auto& [name, time] : after_kill) EXPECT_EQ(solved().at(name), time);
}

TEST_F(Bake, ThatIsInterruptedSaysThatItCanGoOn) {
    const fs::path file = write_body(test::ellipsoid({0.01, 0.02, 0.04}));
    const pid_t child = start_until_first_case(file);
    ::kill(child, SIGINT);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_THAT(read_bytes(folder_ / "stderr"), HasSubstr("run the same command again to continue"));
    EXPECT_FALSE(fs::exists(output_));
}

// Over-relaxed equations diverge for real; written into fvSolution, they do in every attempt.
void make_diverging(const fs::path& case_folder) {
    const fs::path solution = case_folder / "system/fvSolution";
    const std::string text =
        std::regex_replace(read_bytes(solution), std::regex("\\$(momentum|turbulence)Relaxation"), "3.5");
    std::ofstream(solution) << text;
}

TEST_F(Bake, LeavesOutADivergedCaseAndNamesItsLogWhileTheOthersGoOn) {
    const Body body = test::ellipsoid({0.01, 0.02, 0.04});
    const BakePlan plan = plan_bake(body, bake_quality("smoke"), 1e4);
    write_case_folder(cases_, body, plan, foam_cases);
    make_diverging(cases_ / "direction_01_coarse");
    const std::vector<LeftOutCase> left_out = solve_cases(cases_, plan, {2, ""}, foam_cases);
    ASSERT_EQ(left_out.size(), 1u);
    EXPECT_EQ(left_out[0].name, "direction_01_coarse");
    EXPECT_THAT(left_out[0].reason, HasSubstr("simpleFoam diverged"));
    EXPECT_THAT(left_out[0].reason,
                HasSubstr("see " + (cases_ / "direction_01_coarse/log.simpleFoam").string()));
    EXPECT_THAT(left_out[0].reason, Not(HasSubstr("\n")));
    EXPECT_EQ(solved().size(), 5u);
    EXPECT_TRUE(fs::exists(cases_ / "direction_01_coarse/log.simpleFoam"));

    // It is not tried again, until its record is removed.
    const auto before = fs::last_write_time(cases_ / "direction_01_coarse/log.simpleFoam");
    EXPECT_EQ(solve_cases(cases_, plan, {2, ""}, foam_cases).size(), 1u);
    EXPECT_EQ(fs::last_write_time(cases_ / "direction_01_coarse/log.simpleFoam"), before);
}

TEST_F(Bake, WithoutASingleSolvedCaseIsAnErrorThatNamesTheFirst) {
    const Body body = test::sphere(0.01);
    const BakePlan plan = plan_bake(body, bake_quality("smoke"), 1e4);
    write_case_folder(cases_, body, plan, foam_cases);
    make_diverging(cases_ / "direction_00_coarse");
    try {
        solve_cases(cases_, plan, {1, ""}, foam_cases);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("direction_00_coarse: simpleFoam diverged"));
        EXPECT_THAT(error.what(), HasSubstr("1 of 1 cases failed"));
        EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    }
}

TEST_F(Bake, WithoutOpenFoamNamesThePackages) {
    const fs::path file = write_body(test::sphere(0.01));
    const test::ProgramRun run = bake(fmt::format("{} -o out.body.h5", file.string()), "PATH=/nowhere");
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.error, HasSubstr("simpleFoam"));
    EXPECT_THAT(run.error, HasSubstr("apt install openfoam snakemake"));
    EXPECT_EQ(std::count(run.error.begin(), run.error.end(), '\n'), 1);
    EXPECT_FALSE(fs::exists(cases_));
}

TEST_F(Bake, DryRunWritesNothing) {
    const fs::path file = write_body(test::ellipsoid({0.01, 0.02, 0.04}));
    const test::ProgramRun run =
        bake(fmt::format("{} -o out.body.h5 --quality preview --dry-run --json", file.string()));
    ASSERT_EQ(run.status, 0) << run.error;
    EXPECT_EQ(run.json()["cases"].size(), 23u);  // 16 directions, seven of them on two meshes
    EXPECT_GT(run.json()["estimated_cpu_seconds"].get<double>(), 10.0);
    EXPECT_FALSE(fs::exists(output_));
    EXPECT_FALSE(fs::exists(cases_));
}

TEST_F(Bake, IsOfQualityStandardAndSaysItsCostAndTheErrorsToExpect) {
    const fs::path file = write_body(test::sphere(0.01));
    const test::ProgramRun run = bake(fmt::format("{} -o out.body.h5 --dry-run", file.string()));
    EXPECT_EQ(run.status, 0) << run.error;
    EXPECT_THAT(run.output, HasSubstr("12 cases and falls, "));
    EXPECT_THAT(run.output,
                HasSubstr(" MB on disk; on held-out falls bakes of this quality were off by 5 %"));
    const test::ProgramRun smoke =
        bake(fmt::format("{} -o out.body.h5 --quality smoke --json", file.string()));
    EXPECT_EQ(smoke.status, 0) << smoke.error;
    EXPECT_THAT(smoke.error, HasSubstr("samara bake: out.body.h5: quality smoke, 1 cases and falls, "));
    EXPECT_THAT(smoke.error, Not(HasSubstr("held-out")));
}

TEST_F(Bake, SaysWhereTheFlowIsTakenAsLaminar) {
    const fs::path file = write_body(test::sphere(0.0002));
    const test::ProgramRun run = bake(fmt::format("{} -o out.body.h5 --dry-run", file.string()));
    EXPECT_EQ(run.status, 0);
    EXPECT_THAT(run.error, HasSubstr("the flow is assumed laminar"));
}

TEST_F(Bake, OfASmallSphereIsLaminarAndHasItsMeasuredDrag) {
    const fs::path file = write_body(test::sphere(0.0005));
    const test::ProgramRun run = bake(fmt::format("{} -o out.body.h5 --quality smoke --json", file.string()));
    ASSERT_EQ(run.status, 0) << run.error;
    const nlohmann::json json = run.json();
    const double reynolds_number = json["reynolds_numbers"][0];
    ASSERT_LT(reynolds_number, 300.0);
    // Clift & Gauvin (1971); their correlation's own error is 6 %.
    const double measured = 24.0 / reynolds_number * (1.0 + 0.15 * std::pow(reynolds_number, 0.687)) +
                            0.42 / (1.0 + 42500.0 * std::pow(reynolds_number, -1.16));
    EXPECT_NEAR(json["cases"][0]["drag_coefficient"].get<double>(), measured, 0.1 * measured);
    EXPECT_EQ(json["cases"][0]["turbulent_kinetic_energy"], 0.0);
}

TEST_F(Bake, AtGivenReynoldsNumbersHasTheMeasuredDragOfASphere) {
    const fs::path file = write_body(test::sphere(0.01));
    const test::ProgramRun run =
        bake(fmt::format("{} -o out.body.h5 --quality smoke --reynolds-number 150,20 --json", file.string()));
    ASSERT_EQ(run.status, 0) << run.error;
    EXPECT_EQ(run.json()["reynolds_numbers"], nlohmann::json({150.0, 20.0}));
    EXPECT_EQ(read_body_file(output_).tables->reynolds_numbers, (std::vector<double>{20.0, 150.0}));
    for (const nlohmann::json& one : run.json()["cases"]) {
        const double reynolds_number = one["reynolds_number"];
        // Brown & Lawler (2003).
        const double measured = 24.0 / reynolds_number * (1.0 + 0.150 * std::pow(reynolds_number, 0.681)) +
                                0.407 / (1.0 + 8710.0 / reynolds_number);
        EXPECT_NEAR(one["drag_coefficient"].get<double>(), measured, 0.12 * measured) << reynolds_number;
    }
}

TEST_F(Bake, InAGivenFluidIsForTheTerminalSpeedThere) {
    const std::string words = write_body(test::sphere(0.005)).string() +
                              " -o out.body.h5 --quality preview --density 7800 --dry-run --json";
    const double in_water = bake(words).json()["reynolds_numbers"][0];
    const nlohmann::json glycerol = bake(words + " --fluid-density 1261 --fluid-viscosity 1.41").json();
    const double speed = std::sqrt(2.0 * (7800.0 / 1261.0 - 1.0) * 9.81 * 4.0 / 3.0 * 0.005);
    EXPECT_NEAR(glycerol["reynolds_numbers"][0].get<double>(), speed * 0.01 * 1261.0 / 1.41, 0.1);
    EXPECT_EQ(bake(words + " --fluid-density 998.2 --fluid-viscosity 1.002e-3").json()["reynolds_numbers"][0],
              in_water);
}

TEST_F(Bake, AtAGivenReynoldsNumberHasItInItsFallsToo) {
    const nlohmann::json plan = bake(write_body(test::sphere(0.01)).string() +
                                     " -o out.body.h5 --reynolds-number 700 --dry-run --json")
                                    .json();
    EXPECT_EQ(plan["reynolds_numbers"], nlohmann::json({700.0}));
    ASSERT_EQ(plan["falls"].size(), 2u);
    EXPECT_NEAR(plan["falls"][0]["reynolds_number"].get<double>(), 700.0, 1.0);
}

TEST_F(Bake, RejectsFluidsAndReynoldsNumbersThatMakeNoFlow) {
    const std::string shape = write_body(test::sphere(0.01)).string() + " -o out.body.h5 --dry-run ";
    const std::map<std::string, std::string> rejected = {
        {"--fluid-density 1261", "--fluid-density is not enough"},
        {"--fluid air --fluid-density 1261 --fluid-viscosity 1", "--fluid excludes"},
        {"--reynolds-number 50,5e", "must be numbers from 0.01 to 1e7"},
        {"--reynolds-number 50,50.01", "twice"},
        {"--reynolds-number 50 --fluid-density 1261 --fluid-viscosity 1", "sets the viscosity"},
        {"--reynolds-number 1e9", "must be numbers"}};
    for (const auto& [words, message] : rejected) {
        const test::ProgramRun run = bake(shape + words);
        EXPECT_EQ(run.status, 1) << words;
        EXPECT_THAT(run.error, HasSubstr(message));
    }
}

TEST_F(Bake, NotesTheDragCrisis) {
    const std::string words =
        write_body(test::sphere(0.01)).string() + " -o out.body.h5 --quality preview --dry-run ";
    EXPECT_THAT(bake(words + "--reynolds-number 3e5").error, HasSubstr("drag crisis"));
    EXPECT_THAT(bake(words + "--reynolds-number 1e5").error, Not(HasSubstr("drag crisis")));
}

TEST_F(Bake, RejectsABodyAsDenseAsTheFluid) {
    const fs::path file = write_body(test::sphere(0.01));
    const test::ProgramRun run = bake(fmt::format("{} -o out.body.h5 --density 998.2", file.string()));
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.error, HasSubstr("give another density"));
    EXPECT_FALSE(fs::exists(cases_));
}

TEST_F(Bake, OfARangeOfDensitiesNeedsItsOtherEndAndFalls) {
    const std::string shape = write_body(test::sphere(0.01)).string();
    const test::ProgramRun one_end =
        bake(fmt::format("{} -o out.body.h5 --quality standard --density-to 8000", shape));
    EXPECT_EQ(one_end.status, 1);
    EXPECT_THAT(one_end.error, HasSubstr("give both"));
    const test::ProgramRun no_falls =
        bake(fmt::format("{} -o out.body.h5 --quality smoke --density 1200 --density-to 8000", shape));
    EXPECT_EQ(no_falls.status, 1);
    EXPECT_THAT(no_falls.error, HasSubstr("this bake solves none"));
    const test::ProgramRun left_out = bake(fmt::format(
        "{} -o out.body.h5 --quality standard --density 1200 --density-to 8000 --falls none", shape));
    EXPECT_EQ(left_out.status, 1);
    EXPECT_THAT(left_out.error, HasSubstr("this bake solves none"));
    const test::ProgramRun step =
        bake(fmt::format("{} -o out.body.h5 --quality smoke --fall-step 0.5", shape));
    EXPECT_EQ(step.status, 1);
    EXPECT_THAT(step.error, HasSubstr("--fall-step applies to falls"));
    EXPECT_FALSE(fs::exists(cases_));
}

TEST_F(Bake, WithoutFallsPlansTheSameTables) {
    const std::string words = write_body(test::sphere(0.01)).string() +
                              " -o out.body.h5 --quality standard --density 1200 --dry-run --json";
    const nlohmann::json with = bake(words).json();
    const nlohmann::json without = bake(words + " --falls none").json();
    EXPECT_EQ(without["cases"], with["cases"]);
    EXPECT_EQ(with["falls"].size(), 2u);
    EXPECT_TRUE(without["falls"].empty());
}

TEST_F(Bake, OfASceneSolvesInRoundsWhatItVisitsAndEndsTheSameAfterAnInterruption) {
    write_body(test::ellipsoid({0.01, 0.02, 0.04}));
    std::ofstream(folder_ / "scene.toml") << R"([scene]
duration = 3.0
[fluid]
preset = "water"
[[body]]
name = "out"
shape = "ellipsoid.body.h5"
density = 1200
orientation = [0.8, 0, -0.6, 0]
)";
    const std::string words = "scene.toml -o . --quality smoke --tolerance 0.2 --json";
    const test::ProgramRun run = bake(words);
    ASSERT_EQ(run.status, 0) << run.error;
    const nlohmann::json plan = run.json()["bodies"][0]["plan"];
    EXPECT_EQ(plan["stopped_because"], "the tolerance is met") << plan.dump(1);
    EXPECT_GE(plan["rounds"].size(), 1u);
    EXPECT_LT(plan["rounds"].back()["directions"], plan["symmetric_grid"]["directions"]);
    EXPECT_EQ(plan["whole_grid"]["directions"], 258);
    const LoadTables tables = *read_body_file(output_).tables;
    EXPECT_GT(tables.plan.subdivisions, 0);
    EXPECT_EQ(nlohmann::json::parse(tables.plan.report), plan);

    // As if it had been killed in its first round: the last cases are gone, the later rounds' among them.
    const std::string before = data_of(output_);
    fs::remove(output_);
    const auto solved_before = solved();
    for (const auto& [name, time] : solved_before) {
        if (name == solved_before.rbegin()->first) fs::remove(cases_ / name / "provenance.json");
    }
    const test::ProgramRun again = bake(words);
    ASSERT_EQ(again.status, 0) << again.error;
    EXPECT_EQ(data_of(output_), before);
    std::size_t solved_again = 0;
    for (const auto& [name, time] : solved()) solved_again += time != solved_before.at(name) ? 1 : 0;
    EXPECT_EQ(solved_again, 1u);
}

TEST_F(Bake, OfAShapeTakesNoTolerance) {
    const fs::path file = write_body(test::sphere(0.01));
    const test::ProgramRun run = bake(fmt::format("{} -o out.body.h5 --tolerance 0.1", file.string()));
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.error, HasSubstr("--tolerance applies to scenes only"));
}

TEST_F(Bake, OfASceneGivesOneFileForEachBodyAndNoCasesToThoseWithoutTables) {
    write_body(test::sphere(0.01));
    std::ofstream(folder_ / "scene.toml") << R"([scene]
duration = 1.0
[fluid]
preset = "water"
[[body]]
name = "ball"
shape = "sphere.body.h5"
density = 2000
[[body]]
name = "ghost"
shape = "sphere.body.h5"
density = 2000
loads = "none"
turbulence = "none"
)";
    const test::ProgramRun planned = bake("scene.toml -o bodies --quality smoke --dry-run");
    EXPECT_THAT(planned.output, testing::ContainsRegex("all 2 bodies: 1 cases and falls, .*disk\n$"));
    const test::ProgramRun run = bake("scene.toml -o bodies --quality smoke --json");
    ASSERT_EQ(run.status, 0) << run.error;
    ASSERT_EQ(run.json()["bodies"].size(), 2u);
    const Body ball = read_body_file(folder_ / "bodies/ball.body.h5");
    EXPECT_EQ(ball.name, "ball");
    EXPECT_TRUE(ball.tables.has_value());
    EXPECT_FALSE(read_body_file(folder_ / "bodies/ghost.body.h5").tables.has_value());
    EXPECT_FALSE(fs::exists(folder_ / "bodies/ghost.cases"));

    const test::ProgramRun again = bake("scene.toml -o bodies --quality smoke --body ball --dry-run --json");
    EXPECT_EQ(again.json()["bodies"].size(), 1u);
    EXPECT_EQ(again.json()["bodies"][0]["solved"], 1);
    EXPECT_EQ(again.json()["bodies"][0]["longest_chain_seconds"], 0.0);
    EXPECT_THAT(bake("scene.toml -o bodies --body bal").error, HasSubstr("did you mean 'ball'?"));

    const test::ProgramRun mixed = bake("scene.toml -o bodies --density 1200");
    EXPECT_EQ(mixed.status, 1);
    EXPECT_THAT(mixed.error, HasSubstr("leave --density out"));
}

}  // namespace
}  // namespace samara
