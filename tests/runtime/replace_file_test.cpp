#include "samara/files/replace_file.hpp"

#include <fstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/base/content_hash.hpp"
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

}  // namespace
}  // namespace samara
