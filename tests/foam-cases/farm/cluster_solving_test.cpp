// Bakes through a real Slurm that runs on this machine alone (tests/tools/local_slurm.sh).

#include <csignal>
#include <cstdlib>
#include <memory>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include "bake_folder.hpp"
#include "foam-cases/farm/case_farm.hpp"
#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "test_bodies.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;

class Cluster : public test::BakeFolder {
  protected:
    static void SetUpTestSuite() {
        slurm_ = std::make_unique<test::TemporaryFolder>();
        ASSERT_EQ(run_subprocess({script, "start", slurm_->path().string()}), 0);
        ::setenv("SLURM_CONF", (slurm_->path() / "slurm.conf").c_str(), 1);
    }
    static void TearDownTestSuite() {
        run_subprocess({script, "stop", slurm_->path().string()});
        ::unsetenv("SLURM_CONF");
        slurm_.reset();
    }

    [[nodiscard]] std::string jobs() const {
        const fs::path list = folder_ / "squeue";
        EXPECT_EQ(run_subprocess({"squeue", "--noheader", "--format=%i %j %T"}, list), 0);
        return read_bytes(list);
    }
    [[nodiscard]] test::ProgramRun bake_there(const fs::path& body,
                                              const std::string& submit = "sbatch --time=10") const {
        return test::run_program_in(
            temporary_, {"samara-bake", body.string(), "-o", output_.string(), "--quality", "smoke", "--jobs",
                         "2", "--cluster", submit, "--json"});
    }
    // A bake that is at work in a solver on the cluster.
    [[nodiscard]] pid_t start_there(const fs::path& body) const {
        return start_until(
            body,
            [&] { return fs::exists(cases_ / "direction_00_coarse/postProcessing/forces/0/force.dat"); },
            {"--cluster", "sbatch --time=10"});
    }

    static inline const std::string script =
        (fs::path(SAMARA_SOURCE_DIRECTORY) / "tests/tools/local_slurm.sh").string();
    static inline std::unique_ptr<test::TemporaryFolder> slurm_;
};

TEST_F(Cluster, GivesTheSameTablesAsThisMachine) {
    const fs::path body = write_body(test::sphere(0.01));
    const test::ProgramRun here = bake(fmt::format("{} -o out.body.h5 --quality smoke", body.string()));
    ASSERT_EQ(here.status, 0) << here.error;
    const std::string data = data_of(output_);
    fs::remove_all(cases_);
    fs::remove(output_);

    const test::ProgramRun there = bake_there(body);
    ASSERT_EQ(there.status, 0) << there.error;
    EXPECT_EQ(data_of(output_), data);
    EXPECT_TRUE(fs::exists(cases_ / "mesh_coarse" / job_log));
    EXPECT_TRUE(fs::exists(cases_ / "direction_00_coarse" / job_log));
    EXPECT_EQ(jobs(), "");
}

TEST_F(Cluster, NamesAJobThatWasCancelledAndGoesOnNextTime) {
    const fs::path body = write_body(test::sphere(0.01));
    const pid_t child = start_there(body);
    EXPECT_THAT(jobs(), HasSubstr(job_name(cases_)));
    EXPECT_EQ(run_subprocess({"scancel", "--name=" + job_name(cases_)}), 0);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1);
    const std::string error = read_bytes(folder_ / "stderr");
    // Slurm ends the solver and what watches over it: either may be the first to say so.
    EXPECT_THAT(error, AnyOf(AllOf(HasSubstr("direction_00_coarse: its cluster job ended early"),
                                   HasSubstr("CANCELLED")),
                             HasSubstr("direction_00_coarse: was stopped before its end")));
    EXPECT_TRUE(made("failed.json").empty());
    EXPECT_EQ(bake_there(body).status, 0);
}

TEST_F(Cluster, LosesItsJobsOnAnInterruption) {
    const pid_t child = start_there(write_body(test::sphere(0.01)));
    ::kill(child, SIGINT);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_THAT(read_bytes(folder_ / "stderr"), HasSubstr("run the same command again to continue"));
    EXPECT_EQ(jobs(), "");
}

TEST_F(Cluster, EndsTheJobsOfABakeThatWasKilledBeforeItGoesOn) {
    const fs::path body = write_body(test::sphere(0.01));
    const pid_t child = start_there(body);
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_THAT(jobs(), HasSubstr(job_name(cases_)));
    // On this machine: what still runs on the cluster would write into the same case.
    const test::ProgramRun next = bake(fmt::format("{} -o out.body.h5 --quality smoke", body.string()));
    EXPECT_EQ(next.status, 0) << next.error;
    EXPECT_EQ(jobs(), "");
}

TEST_F(Cluster, SaysThatNoSlurmAnswers) {
    const fs::path body = write_body(test::sphere(0.01));
    const std::string configuration = ::getenv("SLURM_CONF");
    ::setenv("SLURM_CONF", temporary_.file("of_no_cluster.conf", "").c_str(), 1);
    const test::ProgramRun run = bake_there(body);
    ::setenv("SLURM_CONF", configuration.c_str(), 1);
    EXPECT_EQ(run.status, 1);
    EXPECT_TRUE(test::is_one_line(run.error)) << run.error;
    EXPECT_THAT(run.error, HasSubstr("Slurm does not respond (squeue failed"));
}

TEST_F(Cluster, SaysThatANodeCouldNotWriteIntoTheFolder) {
    // As if the folder were not visible to the node: Slurm cannot open the job's log there.
    const std::string submit = "sbatch --time=10 --output=" + (folder_ / "nowhere/log").string();
    const test::ProgramRun run = bake_there(write_body(test::sphere(0.01)), submit);
    EXPECT_EQ(run.status, 1);
    EXPECT_THAT(run.error, HasSubstr("mesh_coarse: its cluster job wrote nothing there; use a folder that"));
}

TEST_F(Cluster, TakesNoOtherSchedulerThanSlurm) {
    const test::ProgramRun run = bake("sphere.geo -o out.body.h5 --cluster qsub");
    EXPECT_EQ(run.status, 1);
    EXPECT_TRUE(test::is_one_line(run.error));
    EXPECT_THAT(run.error, HasSubstr("only Slurm's sbatch is supported"));
    EXPECT_NO_THROW(require_sbatch("/opt/slurm/bin/sbatch --time=30"));
}

}  // namespace
}  // namespace samara
