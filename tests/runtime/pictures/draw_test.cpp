#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "picture_files.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/motion/motion_file.hpp"
#include "support/program_run.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::degree;
using test::ProgramRun;
using testing::HasSubstr;

/// The file "motion.h5": an ellipsoid that flutters, and a plate that tumbles.
class Plot : public testing::Test {
  protected:
    Plot() {
        Motion motion =
            test::motion_of([](double t) { return test::flutter(t, 1.1, 40.0 * degree, 0.2); }, 4.0);
        BodyMotion second =
            test::motion_of([](double t) { return test::tumble(t, 8.0, 0.4); }, 4.0).bodies[0];
        second.name = "plate";
        motion.bodies.push_back(second);
        write_motion_file(folder_ / "motion.h5", motion);
    }
    [[nodiscard]] ProgramRun plot(const std::string& output, const std::vector<std::string>& more = {},
                                  const std::string& environment = "") const {
        std::vector<std::string> words = {"samara", "plot", "motion.h5", "-o", output};
        words.insert(words.end(), more.begin(), more.end());
        return run_program_in(folder_, words, environment);
    }
    /// A program that takes python3's place.
    [[nodiscard]] std::string fake_python(const std::string& script) const {
        (void)folder_.file("fake", "#!/bin/sh\n" + script);
        std::filesystem::permissions(folder_ / "fake", std::filesystem::perms::owner_all);
        return "SAMARA_PYTHON=" + (folder_ / "fake").string();
    }
    void expect_rejected(const ProgramRun& done, const char* text) const {
        EXPECT_EQ(done.status, 1);
        EXPECT_TRUE(test::is_one_line(done.error)) << done.error;
        EXPECT_THAT(done.error, HasSubstr(text));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "out.png"));
    }
    test::TemporaryFolder folder_;
};

TEST_F(Plot, IsAPngOfTheStatedSize) {
    const ProgramRun done = plot("out.png", {"--json"});
    ASSERT_EQ(done.status, 0) << done.error;
    test::expect_png(folder_ / "out.png");
    EXPECT_GE(done.json()["silhouettes"], 8);
    EXPECT_EQ(done.json()["strip"], nlohmann::json({0.0, 4.0}));
    EXPECT_EQ(done.json()["measures"]["regime"], "fluttering");
}

TEST_F(Plot, IsOfTheBodyRunAndCopyAskedForAndNamesWhatIsThereOtherwise) {
    const ProgramRun done = plot("out.svg", {"--body", "plate", "--json"});
    ASSERT_EQ(done.status, 0) << done.error;
    EXPECT_EQ(done.json()["body"], "plate");
    EXPECT_EQ(done.json()["measures"]["regime"], "tumbling");
    EXPECT_THAT(read_bytes(folder_ / "out.svg"), HasSubstr("plate: tumbling, descends at 0.4"));
    expect_rejected(plot("out.png", {"--body", "leaf"}), "holds no body 'leaf'; it holds: ellipsoid, plate");
    expect_rejected(plot("out.png", {"--copy", "1"}), "not copy 1");
    expect_rejected(plot("out.png", {"--run", "3"}), "not run 3");
    expect_rejected(plot("out.pdf"), ".png or .svg");
    expect_rejected(plot("none/out.png"), "does not exist");
}

TEST_F(Plot, SaysWhatToInstallWhereAModuleOrPythonIsMissing) {
    expect_rejected(plot("out.png", {}, fake_python("echo matplotlib >&2; exit 3\n")),
                    "needs Python's matplotlib, which is not installed: apt install python3-matplotlib");
    expect_rejected(plot("out.png", {}, "SAMARA_PYTHON=none-such"), "SAMARA_PYTHON names none-such");
}

TEST_F(Plot, PassesOnWhyPythonFailedAndLeavesTheLastPicture) {
    expect_rejected(
        plot("out.png", {}, fake_python("echo 'Traceback'; echo 'MemoryError: full' >&2; exit 1\n")),
        "failed to make the picture: MemoryError: full");
    expect_rejected(plot("out.png", {}, fake_python("exit 0\n")), "no reason");
    (void)folder_.file("kept.png", "as it was");
    EXPECT_EQ(plot("kept.png", {}, fake_python("exit 1\n")).status, 1);
    EXPECT_EQ(read_bytes(folder_ / "kept.png"), "as it was");
}

TEST_F(Plot, RunsAndReadsNothingOfTheUsers) {
    const auto drawn = [&](const std::string& name, const std::string& environment) {
        const ProgramRun done = plot(name, {}, environment);
        EXPECT_EQ(done.status, 0) << done.error;
        return read_bytes(folder_ / name);
    };
    const std::string before = drawn("before.svg", "");
    for (const char* module : {"matplotlib.py", "numpy.py", "json.py", "sitecustomize.py", "samara.py"}) {
        (void)folder_.file(module, "open('" + (folder_ / "pwned").string() + "', 'w')\n");
    }
    (void)folder_.file("matplotlibrc", "savefig.facecolor: red\nfont.size: 30\n");
    (void)folder_.file("matplotlib/matplotlibrc", "figure.figsize: 1, 1\nno such line\n");
    const std::string here = folder_.path().string();
    EXPECT_EQ(before, drawn("after.svg", "HOME=" + here + " XDG_CONFIG_HOME=" + here + " PYTHONPATH=" + here +
                                             " PYTHONSTARTUP=matplotlib.py MPLBACKEND=none MATPLOTLIBRC=" +
                                             here + "/matplotlibrc"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "pwned"));
}

TEST_F(Plot, OfAComparisonShowsBothFilesAndLeavesTheTextWherePythonFails) {
    const std::vector<std::string> words = {"samara", "compare", "motion.h5", "motion.h5",
                                            "--body", "plate",   "-o",        "out.png"};
    const ProgramRun failed = run_program_in(folder_, words, fake_python("exit 1\n"));
    expect_rejected(failed, "failed to make the picture");
    EXPECT_THAT(failed.output, HasSubstr("the motion agrees with the reference"));
    const ProgramRun done = run_program_in(folder_, words);
    ASSERT_EQ(done.status, 0) << done.error;
    EXPECT_THAT(done.output, testing::EndsWith("picture: out.png\n"));
    test::expect_png(folder_ / "out.png");
}

}  // namespace
}  // namespace samara
