#include "samara/core/files/replace_file.hpp"

#include <array>
#include <csignal>
#include <fstream>
#include <functional>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "samara/core/files/content_hash.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using test::error_of;
using testing::HasSubstr;

TEST(ReplaceFile, LeavesTheFileAlone) {
    const test::TemporaryFolder folder;
    replace_file_with(folder / "a.txt", "first");
    replace_file_with(folder / "a.txt", "second");
    EXPECT_EQ(read_bytes(folder / "a.txt"), "second");
    EXPECT_EQ(folder.file_count(), 1);
}

TEST(ReplaceFile, KeepsTheOldFileWhereWritingFails) {
    const test::TemporaryFolder folder;
    replace_file_with(folder / "a.txt", "old");
    const auto half_write = [&] {
        replace_file(folder / "a.txt", [](const std::filesystem::path& temporary) {
            std::ofstream(temporary) << "ha";
            throw std::runtime_error("the writer failed");
        });
    };
    EXPECT_THROW(half_write(), std::runtime_error);
    EXPECT_EQ(read_bytes(folder / "a.txt"), "old");
    EXPECT_EQ(folder.file_count(), 1);
}

TEST(ReplaceFile, NamesTheMissingFolder) {
    const test::TemporaryFolder folder;
    EXPECT_THAT(error_of([&] { replace_file_with(folder / "no/a.txt", "x"); }), HasSubstr("does not exist"));
    EXPECT_EQ(folder.file_count(), 0);
}

TEST(ReplaceFile, RefusesAFolderAsItsTarget) {
    const test::TemporaryFolder folder;
    EXPECT_THAT(error_of([&] { replace_file_with(folder.path(), "x"); }), HasSubstr("is a folder"));
}

TEST(ReplaceFile, NamesAFolderThatTakesNoFiles) {
    // The kernel's own folder: not even root can write there.
    EXPECT_THAT(error_of([] { replace_file_with("/proc/a.txt", "x"); }), HasSubstr("cannot be written"));
}

TEST(ReplaceFile, NamesTheReasonWhereTheDeviceTakesNothing) {
    // A file name longer than file systems allow.
    const test::TemporaryFolder folder;
    EXPECT_THAT(error_of([&] { replace_file_with(folder / std::string(300, 'a'), "x"); }),
                HasSubstr("cannot be written"));
    EXPECT_EQ(folder.file_count(), 0);
}

using Replace = void (*)(const std::filesystem::path&,
                         const std::function<void(const std::filesystem::path&)>&);

/// Lets a process be killed while it writes.
void write_and_be_killed(const test::TemporaryFolder& folder, Replace replace) {
    const pid_t child = ::fork();
    if (child == 0) {
        replace(folder / "a.txt", [](const std::filesystem::path& temporary) {
            std::ofstream(temporary) << "ha" << std::flush;
            ::kill(::getpid(), SIGKILL);
        });
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
}

void write_letter(const std::filesystem::path& file) {
    std::ofstream(file) << "b" << std::flush;
}

TEST(ReplaceFile, LeavesNothingWhenItIsKilled) {
    const test::TemporaryFolder folder;
    write_and_be_killed(folder, replace_file);
    EXPECT_EQ(folder.file_count(), 0);
}

TEST(ReplaceFile, LeavesNoNamedFileAfterTheNextWhenItIsKilled) {
    const test::TemporaryFolder folder;
    write_and_be_killed(folder, replace_file_by_name);
    EXPECT_EQ(folder.file_count(), 1);
    replace_file_by_name(folder / "b.txt", write_letter);
    EXPECT_EQ(folder.file_count(), 1);
    EXPECT_EQ(read_bytes(folder / "b.txt"), "b");
}

TEST(ReplaceFile, LeavesTheTemporaryFilesOfTheLivingAlone) {
    const test::TemporaryFolder folder;
    replace_file_by_name(folder / "a.txt", [&](const std::filesystem::path& temporary) {
        write_letter(temporary);
        replace_file_by_name(folder / "b.txt", write_letter);
    });
    EXPECT_EQ(read_bytes(folder / "a.txt"), "b");
    EXPECT_EQ(folder.file_count(), 2);
}

TEST(ReplaceFile, GivesTheRightsOfOtherNewFiles) {
    const test::TemporaryFolder folder;
    const mode_t mask = ::umask(027);
    replace_file_with(folder / "a.txt", "x");
    ::umask(mask);
    EXPECT_EQ(std::filesystem::status(folder / "a.txt").permissions(), std::filesystem::perms(0640));
}

TEST(TemporaryFolder, OfAKilledProgramIsRemovedByTheNext) {
    std::array<int, 2> pipe = {};
    ASSERT_EQ(::pipe(pipe.data()), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const TemporaryFolder folder;
        std::ofstream(folder / "file") << "x" << std::flush;
        const std::string name = folder.path().string();
        (void)!::write(pipe[1], name.data(), name.size());
        ::kill(::getpid(), SIGKILL);
    }
    ::close(pipe[1]);
    ASSERT_EQ(::waitpid(child, nullptr, 0), child);
    std::string left(4096, '\0');
    left.resize(static_cast<std::size_t>(::read(pipe[0], left.data(), left.size())));
    ::close(pipe[0]);
    const TemporaryFolder living;
    const TemporaryFolder next;
    EXPECT_FALSE(std::filesystem::exists(left));
    EXPECT_TRUE(std::filesystem::exists(living.path()));
}

}  // namespace
}  // namespace samara
