// Falls in real OpenFOAM on the coarse mesh: against theory, and what a kill or a fall that blows up leaves
// behind.

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <functional>
#include <numbers>
#include <thread>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include "converter/falls/fall_record.hpp"
#include "paths.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/dynamics/immersed_body.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/scene/scene_file.hpp"
#include "support/program_run.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// A folder with one scene, solved to out.h5 with its case in out.cases/fall_00.
class Falls : public testing::Test {
  protected:
    /// `scene` and `body`: lines of these tables; the fluid is water of 1000 kg/m^3, or of another viscosity.
    void write_scene(const std::string& scene, const std::string& shape, const std::string& body,
                     double viscosity = 1e-3) {
        static_cast<void>(folder_.file(
            "scene.toml",
            fmt::format(
                "[scene]\nframe_rate = 100\n{}\n[fluid]\ndensity = 1000\nviscosity = {}\n[[body]]\nname = "
                "\"body\"\nshape = \"{}/meshes/shapes/{}.geo\"\nturbulence = \"none\"\n{}\n",
                scene, viscosity, SAMARA_SOURCE_DIRECTORY, shape, body)));
    }
    [[nodiscard]] test::ProgramRun validate(const std::string& environment = "",
                                            const std::vector<std::string>& more = {}) const {
        std::vector<std::string> words = {"samara-validate", "scene.toml", "-o",    "out.h5",
                                          "--cells",         "6000",       "--json"};
        words.insert(words.end(), more.begin(), more.end());
        return test::run_program_in(folder_, words, environment);
    }
    [[nodiscard]] nlohmann::json solved(const std::vector<std::string>& more = {}) const {
        const test::ProgramRun run = validate("", more);
        EXPECT_EQ(run.status, 0) << run.error;
        return run.status == 0 ? run.json() : nlohmann::json();
    }
    [[nodiscard]] nlohmann::json attempts() const {
        return nlohmann::json::parse(read_bytes(fall_ / "attempts.json"))["attempts"];
    }
    [[nodiscard]] std::vector<std::string> names_of_attempts() const {
        std::vector<std::string> names;
        for (const auto& attempt : attempts()) names.push_back(attempt["what"]);
        return names;
    }
    /// A copy of the templates, in which the entry of a fall's parameters stands before or after those of an
    /// attempt.
    [[nodiscard]] std::string templates_with(const std::string& entry, bool before_attempts) const {
        const fs::path copy = folder_.path() / "templates";
        fs::copy(fs::path(SAMARA_SOURCE_DIRECTORY) / "foam-cases", copy, fs::copy_options::recursive);
        const fs::path file = copy / "templates/free-fall/parameters";
        std::string text = read_bytes(file);
        const std::size_t place = before_attempts ? text.find("#includeIfPresent") : text.size();
        text.insert(place, entry + "\n");
        std::ofstream(file) << text;
        return "SAMARA_FOAM_CASES=" + copy.string();
    }
    /// Starts the program and waits until the condition holds; its standard error goes to the file stderr.
    [[nodiscard]] pid_t start_until(const std::function<bool()>& condition) const {
        const std::string program = (fs::path(SAMARA_PROGRAMS) / "samara-validate").string();
        const pid_t child = ::fork();
        if (child == 0) {
            if (::chdir(folder_.path().c_str()) != 0 || std::freopen("stderr", "w", stderr) == nullptr ||
                std::freopen("stdout", "w", stdout) == nullptr) {
                ::_exit(1);
            }
            ::execl(program.c_str(), program.c_str(), "scene.toml", "-o", "out.h5", "--cells", "6000",
                    nullptr);
            ::_exit(1);
        }
        for (int i = 0; i < 6000 && !condition(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        return child;
    }
    [[nodiscard]] bool has_state_after(double time) const {
        if (!fs::exists(fall_)) return false;
        return std::ranges::any_of(fs::directory_iterator(fall_), [&](const fs::directory_entry& entry) {
            const std::string name = entry.path().filename();
            const bool is_time = name.find_first_not_of("0123456789.") == std::string::npos;
            return is_time && std::stod(name) > time;
        });
    }
    /// The ids of the solvers at work in the fall's folder.
    [[nodiscard]] std::vector<pid_t> solvers() const {
        std::vector<pid_t> ids;
        for (const auto& entry : fs::directory_iterator("/proc")) {
            const std::string id = entry.path().filename();
            std::error_code gone;
            const fs::path program = fs::read_symlink(entry.path() / "exe", gone);
            if (gone || program.filename() != "pimpleFoam") continue;
            if (fs::read_symlink(entry.path() / "cwd", gone) == fall_) ids.push_back(std::stoi(id));
        }
        return ids;
    }

    const test::TemporaryFolder folder_;
    const fs::path fall_ = folder_.path() / "out.cases/fall_00";
};

double along(const Vector3d& vector, const Vector3d& direction) {
    return vector.dot(direction.normalized());
}

/// Returns the step that is nearest to a time (L/U).
const FallSample& sample_at(double time, const FallRecord& record) {
    return *std::ranges::min_element(record.samples, {},
                                     [&](const FallSample& sample) { return std::abs(sample.time - time); });
}

TEST_F(Falls, ASphereTakesHalfItsDisplacedMassAlongAndEndsAtItsTerminalSpeed) {
    write_scene("duration = 1.5", "sphere", "density = 1200");
    const nlohmann::json json = solved();
    ASSERT_TRUE(json.is_object());
    const FallRecord record = read_fall_record(fall_);
    const FreeFall& fall = record.fall;

    // From 0.1 to 0.3 L/U it has 0.15 of its terminal speed at most, and so 2 % of its drag.
    const FallSample& early = sample_at(0.1, record);
    const FallSample& late = sample_at(0.3, record);
    const double measured = along(late.velocity - early.velocity, fall.gravity) / (late.time - early.time);
    const double exact = (fall.mass - fall.volume) * fall.gravity.norm() / (fall.mass + 0.5 * fall.volume);
    EXPECT_NEAR(measured, exact, 0.03 * exact);

    // A smooth sphere has drag coefficients of 0.38 to 0.5 at Reynolds numbers from 1e3 to 1e5 (Clift, Grace
    // and Weber 1978, table 5.1).
    const double speed = along(record.samples.back().velocity, fall.gravity);
    const double weight = (fall.mass - fall.volume) * fall.gravity.norm();
    const double drag = weight / (0.5 * speed * speed * std::numbers::pi / 4.0);
    EXPECT_GT(drag, 0.38);
    EXPECT_LT(drag, 0.5);

    EXPECT_LT(json["balance"]["force"].get<double>(), 0.03);
    EXPECT_LT(json["balance"]["moment"].get<double>(), 0.05);
    EXPECT_LT(json["largest_courant_number"].get<double>(), 1.0);
    EXPECT_NEAR(json["body"]["descent_speed"].get<double>(), speed * fall.speed, 0.1 * speed * fall.speed);
    const Motion motion = read_motion_file(folder_.path() / "out.h5");
    EXPECT_EQ(motion.frames(), 151);
    EXPECT_THAT(motion.bodies.front().models, HasSubstr("full CFD"));
}

TEST_F(Falls, EachCopyIsAFallOfItsOwnOnOneMesh) {
    write_scene("duration = 0.08", "sphere",
                "density = 1200\ncount = 2\nspread = { position = [0.01, 0, 0], angle = 0.1 }");
    const nlohmann::json json = solved({"--closure", "kOmegaSSTDDES"});
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json["falls"], 2);
    EXPECT_EQ(json["reused"], false);
    EXPECT_THAT(json["attempts"], ElementsAre("as planned"));
    EXPECT_TRUE(fs::exists(folder_.path() / "out.cases/fall_01/provenance.json"));
    const Motion motion = read_motion_file(folder_.path() / "out.h5");
    const BodyMotion& body = motion.bodies.front();
    ASSERT_EQ(body.copies, 2);
    const Vector3d apart = motion.pose(body, 0, 0, 1).position - motion.pose(body, 0, 0, 0).position;
    EXPECT_GT(apart.norm(), 1e-4);
    for (int copy = 0; copy < 2; ++copy) {
        const Pose& last = motion.pose(body, 0, motion.frames() - 1, copy);
        EXPECT_LT(last.velocity.z(), -0.05);
        EXPECT_LT((last.position - motion.pose(body, 0, 0, copy).position).head<2>().norm(), 1e-4);
    }
    EXPECT_EQ(solved({"--closure", "kOmegaSSTDDES"})["reused"], true);
}

// The fluid is at rest in the first instant, and takes its share of the momentum that the body is given.
TEST_F(Falls, ASphereThatStartsWithAVelocityKeepsItOnceTheFluidMoves) {
    write_scene("duration = 0.16\ngravity = [0, 0, 0]", "sphere", "density = 1200\nvelocity = [0, 0.1, 0]");
    ASSERT_TRUE(solved().is_object());
    const FallRecord record = read_fall_record(fall_);
    EXPECT_NEAR(record.fall.velocity.y(), (1.2 + 0.5) / (1.2 + 0.25), 0.01);
    const FallSample& late = sample_at(0.3, record);
    EXPECT_NEAR(late.velocity.y(), 1.0, 0.05);
    EXPECT_LT(std::hypot(late.velocity.x(), late.velocity.z()), 0.01);
}

// A floating body whose centre of mass is 8 mm below its centroid: omega^2 = rho V g r (K^-1)_xx, where the
// inverse of the inertia of body and fluid determines the point about which it oscillates. In a fluid a
// hundred times as thin as water, whose boundary layer is 40 micrometres thick: that of water oscillates too,
// and makes the period 2.9 % longer.
TEST_F(Falls, ABodyHungOffItsCentroidSwingsAsTheInertiaOfBodyAndFluidSays) {
    write_scene("duration = 0.8", "ellipsoid",
                "mass = 0.0335103\ncenter_of_mass = [0, 0, -0.008]\norientation = [0.99875, 0.049979, 0, 0]",
                1e-5);
    const nlohmann::json json = solved({"--closure", "laminar", "--step", "0.5"});
    ASSERT_TRUE(json.is_object());
    const FallRecord record = read_fall_record(fall_);
    std::vector<double> reversals;  // s: when the motion reverses
    for (std::size_t i = 1; i < record.samples.size(); ++i) {
        const double before = record.samples[i - 1].angular_velocity.x();
        const double after = record.samples[i].angular_velocity.x();
        if (before * after >= 0.0) continue;
        const double share = before / (before - after);
        const double time =
            record.samples[i - 1].time + share * (record.samples[i].time - record.samples[i - 1].time);
        reversals.push_back(time * record.fall.time_unit());
    }
    ASSERT_GE(reversals.size(), 2u);
    const double period = 2.0 * (reversals[1] - reversals[0]);

    const Scene scene = read_scene_file(folder_.path() / "scene.toml");
    SceneBody scene_body = scene.bodies.front();
    scene_body.loads = Loads::none;
    const ImmersedBody body = make_immersed_body(read_body_file(folder_.path() / "out.cases/body.body.h5"),
                                                 scene_body, scene.fluid);
    const double torque = 1000.0 * body.volume * 9.81 * 0.008;
    const double exact = 2.0 * std::numbers::pi / std::sqrt(torque * body.inverse_inertia(0, 0));
    EXPECT_NEAR(period, exact, 0.015 * exact);
    EXPECT_LT(json["balance"]["moment"].get<double>(), 0.03);
}

TEST_F(Falls, OneWithFieldsKeepsItsFlowForAMovie) {
    write_scene("duration = 0.2", "sphere", "density = 2000");
    const nlohmann::json result = solved({"--fields", "20"});
    ASSERT_FALSE(result.empty());
    const fs::path fields = folder_ / "out.cases/fall_00/postProcessing/fields";
    const auto series = nlohmann::json::parse(read_bytes(fields / "fall_00.vtm.series"));
    EXPECT_NEAR(static_cast<double>(series.at("files").size()), 4.0, 1.0);
    for (const auto& file : series.at("files")) {
        const fs::path flow = fields / fs::path(file.at("name").get<std::string>()).stem() / "internal.vtu";
        EXPECT_THAT(read_bytes(flow), AllOf(HasSubstr("Name='U'"), HasSubstr("Name='p'")));
    }
    // Pictures change nothing of the fall.
    const std::string with_fields = read_bytes(folder_ / "out.h5");
    fs::remove_all(folder_ / "out.cases");
    EXPECT_FALSE(solved().empty());
    EXPECT_EQ(read_bytes(folder_ / "out.h5"), with_fields);
}

TEST_F(Falls, ASolvedFallIsReusedAndGivesTheSameBytes) {
    write_scene("duration = 0.1", "sphere", "density = 1200");
    EXPECT_FALSE(solved()["reused"].get<bool>());
    const std::string bytes = read_bytes(folder_.path() / "out.h5");
    fs::remove(folder_.path() / "out.h5");
    EXPECT_TRUE(solved()["reused"].get<bool>());
    EXPECT_EQ(read_bytes(folder_.path() / "out.h5"), bytes);
    // The record of the fall alone: what was solved is judged again, not solved again.
    const auto time = fs::last_write_time(fall_ / "log.pimpleFoam");
    fs::remove(fall_ / "provenance.json");
    static_cast<void>(solved());
    EXPECT_EQ(read_bytes(folder_.path() / "out.h5"), bytes);
    EXPECT_EQ(fs::last_write_time(fall_ / "log.pimpleFoam"), time);
}

TEST_F(Falls, ASolvedFallSaysWhatItDiffersFromAnotherSolutionBy) {
    write_scene("duration = 0.1", "sphere", "density = 1200");
    static_cast<void>(solved());
    Motion other = read_motion_file(folder_ / "out.h5");
    for (Pose& pose : other.bodies[0].poses) pose.position = 1.1 * pose.position;
    write_motion_file(folder_ / "other.h5", other);
    ASSERT_EQ(validate("", {"--other-mesh", "other.h5", "--other-closure", "other.h5,out.h5"}).status, 0);
    const Motion known = read_motion_file(folder_ / "out.h5");
    ASSERT_EQ(known.bodies[0].uncertainties.size(), 2U);  // of a sphere the descent alone
    for (const MetricUncertainty& one : known.bodies[0].uncertainties) {
        EXPECT_EQ(one.metric, "descent_speed");
        EXPECT_NEAR(one.relative, 0.1, 0.01) << one.cause;
    }
    EXPECT_EQ(known.bodies[0].poses.size(), other.bodies[0].poses.size());

    // The motion says so too where it is given in place of the scene: nothing is solved, nothing is said
    // twice.
    const auto judge = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"samara-validate", "out.h5", "-o", "again.h5"};
        words.insert(words.end(), more.begin(), more.end());
        return test::run_program_in(folder_, words);
    };
    const test::ProgramRun run = judge({"--other-mesh", "other.h5", "--other-closure", "other.h5,out.h5"});
    EXPECT_EQ(run.status, 0) << run.error;
    EXPECT_EQ(read_bytes(folder_ / "again.h5"), read_bytes(folder_ / "out.h5"));
    EXPECT_THAT(judge({}).error, HasSubstr("out.h5: is a solved motion; give"));
    fs::remove(folder_ / "again.h5");
    EXPECT_EQ(judge({"--other-mesh", "other.h5", "--dry-run"}).status, 1);
    EXPECT_FALSE(fs::exists(folder_ / "again.h5"));
}

TEST_F(Falls, WhoseSolverIsKilledSaySoAndGoOnFromTheLastState) {
    write_scene("duration = 0.8", "sphere", "density = 1200");
    const pid_t child = start_until([&] { return has_state_after(2.5) && !solvers().empty(); });
    for (const pid_t solver : solvers()) ::kill(solver, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1);
    EXPECT_THAT(read_bytes(folder_.path() / "stderr"), HasSubstr("stopped at time"));
    EXPECT_FALSE(fs::exists(fall_ / "failed.json"));
    EXPECT_FALSE(fs::exists(folder_.path() / "out.h5"));

    EXPECT_THAT(solved()["attempts"], ElementsAre("as planned"));
    const nlohmann::json went_on_from = attempts()[0]["went_on_from"];
    ASSERT_EQ(went_on_from.size(), 1u);
    EXPECT_GE(went_on_from[0].get<double>(), 1.0);
    const FallRecord record = read_fall_record(fall_);
    EXPECT_NEAR(record.samples.back().time, record.fall.duration, record.fall.time_step);
    for (std::size_t i = 1; i < record.samples.size(); ++i) {
        EXPECT_NEAR(record.samples[i].time - record.samples[i - 1].time, record.fall.time_step, 1e-6);
    }
    EXPECT_LT(balance_of(record).force, 0.05);
}

TEST_F(Falls, AnInterruptedOneLeavesNoSolverRunning) {
    write_scene("duration = 0.4", "sphere", "density = 1200");
    for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
        const pid_t child = start_until([&] { return !solvers().empty(); });
        EXPECT_FALSE(solvers().empty());
        ::kill(child, signal);
        int status = 0;
        ::waitpid(child, &status, 0);
        for (int i = 0; i < 200 && !solvers().empty(); ++i) ::usleep(10000);
        EXPECT_TRUE(solvers().empty());
        if (signal == SIGKILL) continue;
        EXPECT_TRUE(WIFEXITED(status));
        EXPECT_THAT(read_bytes(folder_.path() / "stderr"),
                    HasSubstr("run the same command again to continue"));
    }
    EXPECT_THAT(solved()["attempts"], ElementsAre("as planned"));
}

// A body of a twentieth of the fluid's density: where the whole of each new acceleration is taken, it blows
// up.
TEST_F(Falls, OneThatBlowsUpIsSolvedWithHalfTheStep) {
    write_scene("duration = 0.01", "sphere", "density = 50");
    const test::ProgramRun run = validate(templates_with("accelerationRelaxation 1;", true));
    ASSERT_EQ(run.status, 0) << run.error;
    EXPECT_THAT(
        run.error,
        HasSubstr("warning: the fall diverged at the planned settings and was solved with half the step"));
    const nlohmann::json json = run.json();
    EXPECT_THAT(json["attempts"], ElementsAre("as planned", "half the step"));
    EXPECT_TRUE(attempts()[0].contains("end"));
    EXPECT_TRUE(fs::exists(fall_ / "log.pimpleFoam.1"));
    const FallRecord record = read_fall_record(fall_);
    EXPECT_NEAR(record.samples.front().time, 0.5 * record.fall.time_step, 1e-9);
    EXPECT_NEAR(json["time_step"].get<double>(), 0.5 * record.fall.time_step * record.fall.time_unit(), 1e-9);
}

TEST_F(Falls, OneThatDivergesInAllAttemptsIsRejectedInOneLine) {
    write_scene("duration = 0.01", "sphere", "density = 50");
    const std::string templates = templates_with("accelerationRelaxation 1;", false);
    const test::ProgramRun run = validate(templates);
    EXPECT_EQ(run.status, 1);
    // Progress, on a machine that is busy, stands before it.
    const std::string error =
        run.error.substr(std::min(run.error.find("samara validate:"), run.error.size()));
    EXPECT_TRUE(test::is_one_line(error)) << run.error;
    EXPECT_THAT(error, HasSubstr("out.cases/fall_00: diverged in all attempts"));
    EXPECT_THAT(names_of_attempts(), ElementsAre("as planned", "half the step", "a quarter of the step"));
    EXPECT_FALSE(fs::exists(folder_.path() / "out.h5"));
    // Nothing would be otherwise the next time.
    const auto time = fs::last_write_time(fall_ / "attempts.json");
    const test::ProgramRun again = validate(templates);
    EXPECT_EQ(again.status, 1);
    EXPECT_EQ(again.error, error);
    EXPECT_EQ(fs::last_write_time(fall_ / "attempts.json"), time);
}

}  // namespace
}  // namespace samara
