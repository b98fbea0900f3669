// Paths that are too long, lead in circles, are folders or devices without an end, and a TMPDIR that is not
// there, through `samara`.

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "paths.hpp"
#include "samara/core/body/body_file.hpp"
#include "support/known_bodies.hpp"
#include "support/program_run.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using Words = std::vector<std::string>;

/// A rejection in the project's own words.
void expect_rejection(const test::TemporaryFolder& folder, const Words& words, const std::string& reason,
                      const std::string& environment = "") {
    const test::ProgramRun run = test::run_program_in(folder, words, environment);
    EXPECT_EQ(run.status, 1) << words[1];
    EXPECT_TRUE(test::is_one_line(run.error)) << run.error;
    EXPECT_THAT(run.error, AllOf(HasSubstr("samara " + words[1] + ": "), HasSubstr(reason),
                                 Not(HasSubstr("filesystem error")), Not(HasSubstr("std::"))))
        << words[1];
}

/// Every command with `path` as what it reads.
std::vector<Words> readings_of(const std::string& path) {
    return {{"samara", "info", path},
            {"samara", "kirchhoff", path},
            {"samara", "simulate", path, "-o", "out.h5"},
            {"samara", "export", path, "-o", "out.csv"},
            {"samara", "plot", path, "-o", "out.png"},
            {"samara", "compare", path, path}};
}

TEST(HostilePaths, ThatCannotBeReadAreRefusedWithTheReason) {
    const test::TemporaryFolder folder;
    std::filesystem::create_symlink("loop", folder / "loop");
    std::filesystem::create_directory(folder / "folder");
    for (const auto& words : readings_of(std::string(5000, 'a')))
        expect_rejection(folder, words, "name too long");
    for (const auto& words : readings_of("loop")) expect_rejection(folder, words, "levels of symbolic links");
    for (const auto& words : readings_of("folder")) expect_rejection(folder, words, "folder");
    for (const auto& words : readings_of("none")) expect_rejection(folder, words, "none: ");
    expect_rejection(folder, {"samara", "simulate", "/dev/zero", "-o", "out.h5"},
                     "/dev/zero: is a pipe, socket or device; give a file");
}

TEST(HostilePaths, OfShapesAndBakedBodiesNameThePlaceInTheScene) {
    const test::TemporaryFolder folder;
    std::filesystem::create_symlink("loop", folder / "loop");
    const auto simulated = [&](const std::string& shape, const Words& more, const std::string& reason) {
        (void)folder.file(
            "scene.toml",
            "[scene]\nduration = 0.1\n[[body]]\nname = \"rubber\"\ndensity = 1\nshape = \"" + shape + "\"\n");
        Words words = {"samara", "simulate", "scene.toml", "-o", "out.h5"};
        words.insert(words.end(), more.begin(), more.end());
        expect_rejection(folder, words, reason);
    };
    simulated(std::string(5000, 'a'), {}, "scene.toml:6: shape");
    simulated("loop", {}, "levels of symbolic links");
    simulated(".", {}, "is a folder; give a file");
    write_body_file(folder / "rubber.body.h5", test::rubber_ellipsoid());
    simulated("rubber.body.h5", {"--bodies", std::string(5000, 'a')}, "name too long");
    simulated("rubber.body.h5", {"--bodies", "loop"}, "levels of symbolic links");
}

TEST(HostilePaths, OfPipesAndDevicesInASceneAreRefusedWithoutWaiting) {
    const test::TemporaryFolder folder;
    write_body_file(folder / "rubber.body.h5", test::rubber_ellipsoid());
    for (const char* name : {"pipe.obj", "pipe.stl", "pipe.glb", "pipe.h5", "pipe.body.h5", "pipe.toml"}) {
        ASSERT_EQ(::mkfifo((folder / name).c_str(), 0600), 0);
    }
    std::filesystem::create_symlink("/dev/zero", folder / "zero.obj");
    const std::string body = "[[body]]\nname = \"a\"\ndensity = 1200\nshape = \"rubber.body.h5\"\n";
    for (const std::string& rest : {
             body + "look = \"pipe.obj\"\n",
             body + "look = \"pipe.glb\"\n",
             body + "look = \"zero.obj\"\n",
             body + "[body.emitter]\nshape = \"pipe.stl\"\n",
             body + "[[obstacle]]\nname = \"o\"\nshape = \"pipe.obj\"\n",
             body + "[[obstacle]]\nname = \"o\"\nshape = \"zero.obj\"\n",
             body + "[wind.file]\npath = \"pipe.h5\"\n",
             std::string("[[body]]\nname = \"a\"\ndensity = 1200\nshape = \"pipe.body.h5\"\n"),
             std::string("[[body]]\nname = \"a\"\ndensity = 1200\nshape = \"pipe.stl\"\n"),
         }) {
        (void)folder.file("scene.toml", "[scene]\nduration = 0.1\n" + rest);
        expect_rejection(folder, {"samara", "simulate", "scene.toml", "-o", "out.h5"},
                         "is a pipe, socket or device; give a file");
    }
    expect_rejection(folder, {"samara", "simulate", "pipe.toml", "-o", "out.h5"},
                     "is a pipe, socket or device");
    for (const auto& words : readings_of("pipe.body.h5"))
        expect_rejection(folder, words, "is a pipe, socket");
}

TEST(HostilePaths, ThatCannotBeWrittenAreRefusedWithTheReason) {
    const test::TemporaryFolder folder;
    write_body_file(folder / "rubber.body.h5", test::rubber_ellipsoid());
    (void)folder.file("scene.toml",
                      "[scene]\nduration = 0.1\n[[body]]\nname = \"rubber\"\nshape = \"rubber.body.h5\"\n"
                      "density = 1200\nloads = \"none\"\n");
    std::filesystem::create_symlink("loop", folder / "loop");
    ASSERT_EQ(test::run_program_in(folder, {"samara", "simulate", "scene.toml", "-o", "motion.h5"}).status,
              0);
    const std::ptrdiff_t before = folder.file_count();
    for (const std::string& out : {std::string(5000, 'a') + "/out", std::string("loop/out"),
                                   std::string("none/out"), std::string("scene.toml/out")}) {
        expect_rejection(folder, {"samara", "simulate", "scene.toml", "-o", out + ".h5"}, ": ");
        expect_rejection(folder, {"samara", "export", "motion.h5", "-o", out + ".glb"}, ": ");
        expect_rejection(folder, {"samara", "export", "motion.h5", "-o", out + ".csv"}, ": ");
        expect_rejection(folder, {"samara", "plot", "motion.h5", "-o", out + ".svg"}, ": ");
        expect_rejection(folder, {"samara", "kirchhoff", "rubber.body.h5", "-o", out + ".body.h5"}, ": ");
    }
    EXPECT_LE(folder.file_count(), before + 2) << "beside what the programs said";
}

TEST(HostilePaths, OfOutputsAreSeenBeforeTheWork) {
    const test::TemporaryFolder folder;
    (void)folder.file("not-read", "and no file of samara's");
    for (const Words& words :
         {Words{"export", "not-read", "-o", "none/out.glb"}, Words{"plot", "not-read", "-o", "none/out.png"},
          Words{"compare", "not-read", "not-read", "-o", "none/out.png"},
          Words{"simulate", "not-read", "-o", "none/out.h5"},
          Words{"search", "not-read", "--target", "0,0,0,1", "-o", "none/out.h5"},
          Words{"kirchhoff", "not-read", "-o", "none/out.body.h5"},
          Words{"mass", "not-read", "-o", "none/out.body.h5"},
          Words{"report", "not-read", "-o", "none/out.html"}}) {
        Words command = words;
        command.insert(command.begin(), "samara");
        expect_rejection(folder, command, "the folder none does not exist; create it first");
    }
    for (const Words& words : {Words{"bake", "not-read.toml", "-o", "not-read/out"},
                               Words{"bake", "not-read", "-o", "not-read/below/out.body.h5"},
                               Words{"validate", "not-read", "-o", "not-read/out.h5"}}) {
        if (!std::filesystem::exists(SAMARA_PROGRAMS "/samara-" + words.front())) continue;  // a baking tool
        Words command = words;
        command.insert(command.begin(), "samara");
        expect_rejection(folder, command, "as not-read is a file; give another folder");
    }
    std::filesystem::create_directory(folder / "out.h5");
    expect_rejection(folder, {"samara", "simulate", "not-read", "-o", "out.h5"}, "out.h5: is a folder");
}

TEST(HostilePaths, OfTemporaryFoldersNameTheVariable) {
    const test::TemporaryFolder folder;
    write_body_file(folder / "rubber.body.h5", test::rubber_ellipsoid());
    (void)folder.file("scene.toml",
                      "[scene]\nduration = 0.1\n[[body]]\nname = \"rubber\"\nshape = \"rubber.body.h5\"\n"
                      "density = 1200\nloads = \"none\"\n");
    ASSERT_EQ(test::run_program_in(folder, {"samara", "simulate", "scene.toml", "-o", "motion.h5"}).status,
              0);
    for (const std::string& place :
         {std::string("/nowhere"), std::string(5000, 'a'), std::string("scene.toml")}) {
        expect_rejection(folder, {"samara", "plot", "motion.h5", "-o", "out.png"}, "TMPDIR",
                         "TMPDIR=" + place);
    }
}

}  // namespace
}  // namespace samara
