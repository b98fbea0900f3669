// Standard streams that are closed or full, readers that leave, and limits on files, through `samara`.

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/motion/motion_file.hpp"
#include "support/known_bodies.hpp"
#include "support/program_run.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

class ProgramStreams : public ::testing::Test {
  protected:
    ProgramStreams() {
        Body body = test::rubber_ellipsoid();
        body.kirchhoff->error_estimate = 0.5;  // which simulate has a note for
        write_body_file(folder_ / "rubber.body.h5", body);
        (void)folder_.file(
            "scene.toml",
            "[scene]\nduration = 0.1\n[[body]]\nname = \"rubber\"\nshape = \"rubber.body.h5\"\n"
            "density = 1200\nloads = \"none\"\n");
    }
    /// The exit status of a shell command in the folder, where $SAMARA is the program.
    [[nodiscard]] int shell(const std::string& command) const {
        return run_subprocess(
            {"/bin/sh", "-c",
             "SAMARA='" SAMARA_PROGRAMS "/samara'; cd '" + folder_.path().string() + "' && " + command});
    }
    [[nodiscard]] std::string error() const { return read_bytes(folder_ / "errors"); }

    const test::TemporaryFolder folder_;
};

TEST_F(ProgramStreams, AFullStandardOutputIsAnErrorForEveryKindOfOutput) {
    for (const char* words : {"--help", "--version", "--list-commands", "simulate --help",
                              "simulate --version", "simulate --list-options", "info rubber.body.h5",
                              "info rubber.body.h5 --json", "simulate scene.toml -o motion.h5"}) {
        EXPECT_EQ(shell(std::string("\"$SAMARA\" ") + words + " > /dev/full 2> errors"), 1) << words;
        EXPECT_TRUE(test::is_one_line(error().substr(error().find("standard output")))) << error();
        EXPECT_THAT(error(), HasSubstr("standard output cannot be written: No space left on device"))
            << words;
    }
}

TEST_F(ProgramStreams, AStandardErrorThatIsClosedOrFullLosesItsNotesAlone) {
    for (const char* stream : {"2>&-", "2> /dev/full"}) {
        EXPECT_EQ(shell(std::string("\"$SAMARA\" simulate scene.toml -o motion.h5 > output ") + stream), 0)
            << stream;
        EXPECT_EQ(read_motion_file(folder_ / "motion.h5").frames(), 7);
        EXPECT_THAT(read_bytes(folder_ / "output"), HasSubstr("-> motion.h5"));
        EXPECT_EQ(shell(std::string("\"$SAMARA\" simulate none.toml -o motion.h5 ") + stream), 1) << stream;
        EXPECT_EQ(shell(std::string("\"$SAMARA\" nonsense ") + stream), 1) << stream;
    }
}

TEST_F(ProgramStreams, WhatIsPrintedNeverEndsUpInAFileThatIsWritten) {
    ASSERT_EQ(shell("\"$SAMARA\" simulate scene.toml -o whole.h5 > output 2> errors"), 0) << error();
    EXPECT_EQ(shell("\"$SAMARA\" simulate scene.toml -o motion.h5 <&- >&- 2> errors"), 1);
    EXPECT_THAT(error(), HasSubstr("standard output cannot be written: Bad file descriptor"));
    EXPECT_EQ(shell("\"$SAMARA\" simulate scene.toml -o other.h5 <&- >&- 2>&-"), 1);
    EXPECT_EQ(read_bytes(folder_ / "motion.h5"), read_bytes(folder_ / "whole.h5"));
    EXPECT_EQ(read_bytes(folder_ / "other.h5"), read_bytes(folder_ / "whole.h5"));
}

TEST_F(ProgramStreams, AReaderThatLeavesIsAnErrorNotADeath) {
    ASSERT_EQ(shell("{ sleep 0.2; \"$SAMARA\" --help 2> errors; echo $? > status; } | true"), 0);
    EXPECT_EQ(read_bytes(folder_ / "status"), "1\n");
    EXPECT_THAT(error(), HasSubstr("standard output cannot be written: Broken pipe"));
}

TEST_F(ProgramStreams, AFileBeyondTheShellsLimitIsAnErrorAndLeavesNothing) {
    ASSERT_EQ(shell("\"$SAMARA\" simulate scene.toml -o motion.h5 > output 2> errors"), 0) << error();
    for (const char* words :
         {"simulate scene.toml -o out.h5", "export motion.h5 -o out.csv", "export motion.h5 -o out.usda",
          "export motion.h5 -o out.glb", "plot motion.h5 -o out.png"}) {
        const std::ptrdiff_t before = folder_.file_count();
        EXPECT_EQ(shell(std::string("ulimit -f 1 && \"$SAMARA\" ") + words + " > output 2> errors"), 1)
            << words;
        EXPECT_THAT(error(), testing::EndsWith("\n")) << words;
        EXPECT_EQ(folder_.file_count(), before) << words;
    }
}

TEST_F(ProgramStreams, ProgramsThatAreStartedGetTheSignalsAsTheyWere) {
    // Python as plot starts it, replaced by one that says how it was started.
    (void)folder_.file("bin/python", "#!/bin/sh\ngrep SigIgn /proc/self/status > " +
                                         (folder_ / "ignored").string() + "\nexit 1\n");
    std::filesystem::permissions(folder_ / "bin/python", std::filesystem::perms::owner_all);
    ASSERT_EQ(shell("\"$SAMARA\" simulate scene.toml -o motion.h5 > output 2> errors"), 0) << error();
    EXPECT_EQ(shell("SAMARA_PYTHON=\"$PWD/bin/python\" \"$SAMARA\" plot motion.h5 -o out.png 2> errors"), 1);
    const std::string of_python = read_bytes(folder_ / "ignored");
    ASSERT_EQ(shell("grep SigIgn /proc/self/status > ignored"), 0);
    EXPECT_EQ(of_python, read_bytes(folder_ / "ignored"));
}

}  // namespace
}  // namespace samara
