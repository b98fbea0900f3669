// Real OpenFOAM runs at smoke quality: what is solved again, and what a kill leaves behind.

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>

#include "bake_folder.hpp"
#include "paths.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path foam_cases = fs::path(SAMARA_SOURCE_DIRECTORY) / "foam-cases";

std::set<std::string> names_of_newer(const std::map<std::string, fs::file_time_type>& now,
                                     const std::map<std::string, fs::file_time_type>& before) {
    std::set<std::string> names;
    for (const auto& [name, time] : now) {
        if (!before.contains(name) || before.at(name) != time) names.insert(name);
    }
    return names;
}

// The ids of the running processes whose command line holds the text and that work in the folder or below.
std::vector<pid_t> processes(const std::string& program, const fs::path& folder) {
    std::vector<pid_t> ids;
    for (const auto& entry : fs::directory_iterator("/proc")) {
        const std::string id = entry.path().filename();
        if (id.find_first_not_of("0123456789") != std::string::npos) continue;
        std::error_code gone;
        const fs::path place = fs::read_symlink(entry.path() / "cwd", gone);
        if (gone || !place.string().starts_with(folder.string())) continue;
        std::ifstream file(entry.path() / "cmdline");
        const std::string words((std::istreambuf_iterator<char>(file)), {});
        if (words.find(program) != std::string::npos) ids.push_back(std::atoi(id.c_str()));
    }
    return ids;
}

class Farm : public test::BakeFolder {
  protected:
    const fs::path body_ = write_body(test::ellipsoid({0.01, 0.02, 0.04}));
    const std::string words_ = fmt::format("{} -o out.body.h5 --quality smoke --json", body_.string());

    std::string baked(const std::string& more = "", const std::string& environment = "") {
        const test::ProgramRun run = bake(words_ + more, environment);
        EXPECT_EQ(run.status, 0) << run.error;
        return run.status == 0 ? data_of(output_) : "";
    }
    [[nodiscard]] bool solver_is_at(int iteration) const {
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(cases_, none)) {
            if (fs::exists(entry.path() / fmt::format("postProcessing/forces/{}/force.dat", iteration)))
                return true;
        }
        return false;
    }
};

// A bake that was never interrupted, and bakes that were killed at each of several moments.
TEST_F(Farm, GivesTheSameTablesAfterAKillAtAnyMoment) {
    const std::string whole = baked();
    ASSERT_FALSE(whole.empty());
    const std::vector<std::pair<std::string, std::function<bool()>>> moments = {
        {"while the case folder is written", [&] { return fs::exists(cases_ / "body.body.h5"); }},
        {"in the mesh", [&] { return fs::exists(cases_ / "mesh_coarse/log.snappyHexMesh"); }},
        {"in the first round", [&] { return solver_is_at(0); }},
        {"in a later round", [&] { return solver_is_at(50); }},
        {"after the second case", [&] { return solved().size() >= 2; }},
        {"before the tables", [&] { return solved().size() == 6; }}};
    fs::remove_all(cases_);
    fs::remove(output_);
    for (const auto& [moment, has_come] : moments) {
        const pid_t child = start_until(body_, has_come);
        ::kill(child, SIGKILL);
        int status = 0;
        ::waitpid(child, &status, 0);
        EXPECT_TRUE(WIFSIGNALED(status)) << moment << ": came too late";
        for (int i = 0; i < 100 && !processes("", cases_).empty(); ++i) ::usleep(20000);
        EXPECT_TRUE(processes("", cases_).empty()) << moment;
    }
    EXPECT_EQ(baked(), whole);
}

TEST_F(Farm, RunsNothingThatAStrangerLeftInItsFolder) {
    const pid_t child = start_until_first_case(body_);
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    for (int i = 0; i < 100 && !processes("", cases_).empty(); ++i) ::usleep(20000);
    const fs::path ran = folder_ / "ran";
    const std::string script = fmt::format("open('{}', 'w').close()\n", ran.string());
    for (const char* name :
         {"json.py", "direction_01_coarse/json.py", "direction_01_coarse/system/fvOptions"}) {
        std::ofstream(cases_ / name) << script;
        const test::ProgramRun run = bake(words_);
        EXPECT_EQ(run.status, 1);
        EXPECT_THAT(run.error, HasSubstr(fmt::format("out.cases/{}: is ", name)));
        fs::remove(cases_ / name);
    }
    // These are rewritten, or removed.
    fs::create_directories(cases_ / ".snakemake/scripts");
    std::ofstream(cases_ / ".snakemake/scripts/strange.py") << script;
    std::ofstream(cases_ / "direction_01_coarse/Allrun") << "#!/bin/sh\ntouch '" << ran.string() << "'\n";
    std::ofstream(cases_ / "direction_01_coarse/case_files.py") << script;
    EXPECT_FALSE(baked().empty());
    EXPECT_FALSE(fs::exists(ran));
}

TEST_F(Farm, WhoseSolverIsKilledSaysSoAndGoesOnFromTheLastRound) {
    const std::string whole = baked();
    fs::remove_all(cases_);
    fs::remove(output_);
    const pid_t child = start_until(body_, [&] { return solver_is_at(0); });
    for (int i = 0; i < 500 && processes("simpleFoam", cases_).empty(); ++i) ::usleep(10000);
    for (const pid_t solver : processes("simpleFoam", cases_)) ::kill(solver, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_THAT(read_bytes(folder_ / "stderr"), HasSubstr("stopped"));
    EXPECT_TRUE(made("failed.json").empty());
    EXPECT_EQ(solved().size(), 5u);
    EXPECT_EQ(baked(), whole);
}

TEST_F(Farm, SolvesAgainOnlyWhatDependsOnTheInputThatChanged) {
    const fs::path own_foam_cases = folder_ / "templates";
    fs::copy(foam_cases, own_foam_cases, fs::copy_options::recursive);
    const std::string environment = "SAMARA_FOAM_CASES=" + own_foam_cases.string();
    const std::string first = baked("", environment);
    auto meshes = made("mesh.json");
    auto cases = solved();
    ASSERT_EQ(cases.size(), 6u);
    const auto changed_meshes = [&] {
        return names_of_newer(made("mesh.json"), std::exchange(meshes, made("mesh.json")));
    };
    const auto changed_cases = [&] {
        return names_of_newer(solved(), std::exchange(cases, solved())).size();
    };

    // Nothing changed.
    EXPECT_EQ(baked("", environment), first);
    EXPECT_EQ(changed_meshes().size(), 0u);
    EXPECT_EQ(changed_cases(), 0u);

    // The record of one case.
    fs::remove(cases_ / cases.begin()->first / "provenance.json");
    EXPECT_EQ(baked("", environment), first);
    EXPECT_EQ(changed_meshes().size(), 0u);
    EXPECT_EQ(changed_cases(), 1u);

    // A file of the solver's, in the template.
    std::ofstream(own_foam_cases / "templates/body-flow/system/fvSolution", std::ios::app)
        << "// tried out\n";
    EXPECT_EQ(baked("", environment), first);
    EXPECT_EQ(changed_meshes().size(), 0u);
    EXPECT_EQ(changed_cases(), 6u);

    // A lighter body that rises as fast as the other falls, at the same Reynolds number.
    EXPECT_EQ(baked(" --density 796.4", environment), first);
    EXPECT_EQ(changed_meshes().size(), 0u);
    EXPECT_EQ(changed_cases(), 0u);

    // Another density falls at another Reynolds number.
    EXPECT_NE(baked(" --density 1300", environment), first);
    EXPECT_EQ(changed_meshes().size(), 0u);
    EXPECT_EQ(changed_cases(), 6u);

    // A file of the mesh's, in the template.
    std::ofstream(own_foam_cases / "templates/body-flow/system/snappyHexMeshDict", std::ios::app)
        << "// tried out\n";
    EXPECT_EQ(baked("", environment), first);
    EXPECT_EQ(changed_meshes().size(), 1u);
    EXPECT_EQ(changed_cases(), 6u);
}

TEST_F(Farm, OnTwoProcessesGivesTheForcesOfOneWithinAPercent) {
    const test::ProgramRun one = bake(words_);
    ASSERT_EQ(one.status, 0) << one.error;
    const auto before = solved();
    const test::ProgramRun two = bake(words_ + " --ranks 2");
    ASSERT_EQ(two.status, 0) << two.error;
    EXPECT_EQ(names_of_newer(solved(), before).size(), 6u);
    EXPECT_EQ(made("mesh.json").size(), 1u);
    EXPECT_THAT(read_bytes(cases_ / "direction_00_coarse/log.simpleFoam"), HasSubstr("nProcs : 2"));
    EXPECT_FALSE(fs::exists(cases_ / "direction_00_coarse/processor0"));
    const auto forces_of = [](const test::ProgramRun& run) {
        std::vector<Vector3d> forces;
        const nlohmann::json json = run.json();
        for (const nlohmann::json& solved : json["cases"]) {
            const nlohmann::json& force = solved["force"];
            forces.emplace_back(force[0].get<double>(), force[1].get<double>(), force[2].get<double>());
        }
        return forces;
    };
    const std::vector<Vector3d> by_one = forces_of(one);
    const std::vector<Vector3d> by_two = forces_of(two);
    ASSERT_EQ(by_one.size(), 6u);
    ASSERT_EQ(by_two.size(), 6u);
    double largest = 0.0;
    for (const Vector3d& force : by_one) largest = std::max(largest, force.norm());
    for (std::size_t i = 0; i < by_one.size(); ++i) {
        EXPECT_LT((by_one[i] - by_two[i]).norm(), 0.01 * largest) << i;
    }
}

}  // namespace
}  // namespace samara
