// Shape files from strangers: what they try ends in one line and leaves nothing behind.

#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshes/make_body.hpp"
#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

const std::string box = "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\n";

std::string error_of(const std::filesystem::path& shape, const MeshOptions& options = {}) {
    const std::string error = test::error_of([&] { make_body(shape, options); });
    EXPECT_THAT(error, StartsWith(shape.string() + ": "));
    EXPECT_THAT(error, Not(HasSubstr("\n")));
    return error;
}

TEST(UntrustedShape, AScriptStartsNoProgramAndWritesNoFile) {
    const test::TemporaryFolder folder;
    for (const char* statement :
         {"SystemCall \"touch made\";", "NonBlockingSystemCall \"touch made\";", "System \"touch made\";",
          "Printf(\"x\") > \"made\";", "Printf(\"x\") >> \"made\";", "Save \"made.msh\";",
          "Print \"made.opt\";", "CreateDir \"made\";", "OnelabRun(\"touch\", \"touch made\");"}) {
        const auto shape = folder.file("a.geo", box + statement);
        EXPECT_THAT(error_of(shape), HasSubstr("line 3: ")) << statement;
        // Included files are not checked; their commands fail when run, though without a message.
        const auto including = folder.file("b.geo", box + "Include \"statement.inc\";");
        const auto included = folder.file("statement.inc", statement);
        try {
            make_body(including);
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), Not(HasSubstr("\n"))) << statement;
        }
        EXPECT_EQ(folder.file_count(), 3) << statement;
    }
}

TEST(UntrustedShape, AFieldStartsNoProgram) {
    const test::TemporaryFolder folder;
    const std::string field =
        "Field[1] = ExternalProcess;\nField[1].CommandLine = \"touch made\";\nBackground Field = 1;\n";
    EXPECT_THAT(error_of(folder.file("a.geo", box + field)), HasSubstr("line 3: ExternalProcess"));
    const auto included = folder.file("field.inc", field);
    MeshOptions keep;
    keep.sizing = MeshOptions::Sizing::keep;
    // gmsh 4.8 has errors there: it may crash before the command.
    EXPECT_THAT(error_of(folder.file("b.geo", box + "Include \"field.inc\";"), keep),
                AnyOf(HasSubstr("tries to start a program"), HasSubstr("ended by signal")));
    EXPECT_EQ(folder.file_count(), 3);
}

TEST(UntrustedShape, AScriptMayReadOtherFilesOfItsFolder) {
    const test::TemporaryFolder folder;
    const auto sizes = folder.file("sizes.inc", "side = 2;\n");
    const auto shape = folder.file(
        "a.geo",
        "Include \"sizes.inc\";\nSetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, side, side, side};\n");
    EXPECT_NEAR(make_body(shape).moments.volume, 8.0, 1e-12);
}

TEST(UntrustedShape, AScriptWithTheNameOfAnotherFormatIsNotRead) {
    const test::TemporaryFolder folder;
    for (const char* name :
         {"a.msh", "a.MSH", "a.step", "a.StEp", "a.stp", "a.brep", "a.Brep", "a.stl", "a.obj"}) {
        const auto shape = folder.file(name, "SystemCall \"touch made\";\n" + box);
        EXPECT_THAT(error_of(shape), Not(HasSubstr("SystemCall"))) << name;
        EXPECT_FALSE(std::filesystem::exists(folder / "made")) << name;
    }
    EXPECT_THAT(error_of(folder / "a.msh"),
                HasSubstr("is not a valid MSH file: a file of this type begins with $MeshFormat"));
    EXPECT_THAT(error_of(folder / "a.StEp"),
                HasSubstr("is not a valid STEP file: a file of this type begins with ISO-10303-21"));
    EXPECT_THAT(error_of(folder / "a.brep"), HasSubstr("is not a valid BREP file"));
    for (const char* name : {"e.msh", "e.step", "e.brep", "e.stl"}) {
        EXPECT_THAT(error_of(folder.file(name, "")), HasSubstr("is empty")) << name;
    }
}

TEST(UntrustedShape, AMeshThatGoesOnAsAScriptStartsNoProgram) {
    const test::TemporaryFolder folder;
    for (const char* start : {"$MeshFormat\"; ", "$Comments\n$EndComments\n", "$NOD\n"}) {
        EXPECT_NE(error_of(folder.file("a.msh", start + std::string("SystemCall \"touch made\";\n"))), "");
        EXPECT_EQ(folder.file_count(), 1);
    }
}

TEST(UntrustedShape, AnExitIsAError) {
    const test::TemporaryFolder folder;
    EXPECT_THAT(error_of(folder.file("a.geo", box + "Exit;\n")), HasSubstr("line 3: Exit ends gmsh"));
    const auto included = folder.file("exit.inc", "Exit;\n");
    EXPECT_THAT(error_of(folder.file("b.geo", box + "Include \"exit.inc\";\n")),
                HasSubstr("before the end of the file"));
}

TEST(UntrustedShape, AnEndlessScriptHasAnEnd) {
    const test::TemporaryFolder folder;
    MeshOptions options;
    options.time_limit = 1.0;
    const auto shape =
        folder.file("a.geo", "For i In {1 : 1000000}\nFor j In {1 : 1000000}\nx = i + j;\nEndFor\nEndFor\n");
    EXPECT_THAT(error_of(shape, options), HasSubstr("needs more than 1 s of CPU time; simplify it"));
}

TEST(UntrustedShape, ACrashOfItsReaderIsOneLine) {
    const test::TemporaryFolder folder;
    // gmsh 4.8 prints into 5000 bytes.
    const auto shape =
        folder.file("a.geo", fmt::format("s = \"{:a<900}\";\nt = StrCat(s, s, s, s, s, s, s, s);\n"
                                         "Printf(t, 1);\n",
                                         ""));
    EXPECT_THAT(error_of(shape), HasSubstr("ended by signal"));
}

TEST(UntrustedShape, SimulateMeshesARawShapeUnderTheSameRules) {
    const test::TemporaryFolder folder;
    const test::TemporaryFolder outside;
    const auto shape = folder.file("a.geo", box + "SystemCall \"touch made\";\n");
    const auto scene =
        folder.file("scene.toml",
                    "[scene]\nduration = 0.1\nstep = 0.01\n[fluid]\npreset = \"water\"\n"
                    "[[body]]\nname = \"a\"\nshape = \"a.geo\"\ndensity = 1200\nloads = \"none\"\n"
                    "turbulence = \"none\"\n");
    const int status =
        run_subprocess({SAMARA_PROGRAMS "/samara", "simulate", scene.string(), "-o", "motion.h5"},
                       outside / "log", folder.path());
    EXPECT_EQ(status, 1);
    EXPECT_THAT(read_bytes(outside / "log"), HasSubstr("line 3: SystemCall starts a program"));
    EXPECT_EQ(folder.file_count(), 2);
}

}  // namespace
}  // namespace samara
