#include "samara/core/files/input_file.hpp"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "samara/core/files/content_hash.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using test::TemporaryFolder;
using testing::HasSubstr;

TEST(InputFile, SaysWhatIsWrongWithAPathAndNeverThrows) {
    const TemporaryFolder folder;
    EXPECT_EQ(reading_error(folder.file("a.h5", "text")), "");
    EXPECT_EQ(reading_error("/dev/null"), "is a pipe, socket or device; give a file");
    EXPECT_EQ(reading_error(folder / "b.h5"), "does not exist; check the name");
    EXPECT_EQ(reading_error(folder.path()), "is a folder; give a file");
    EXPECT_EQ(reading_error(folder / "a.h5/b.h5"), "cannot be read: Not a directory");
    EXPECT_EQ(reading_error(std::string(5000, 'a')), "cannot be read: File name too long");
    std::filesystem::create_symlink("loop", folder / "loop");
    EXPECT_EQ(reading_error(folder / "loop"), "cannot be read: Too many levels of symbolic links");
    std::filesystem::create_symlink("gone", folder / "dangling");
    EXPECT_EQ(reading_error(folder / "dangling"), "does not exist; check the name");
}

TEST(InputFile, IsReadWholeOrRefused) {
    const TemporaryFolder folder;
    const std::string text(100'000, 'x');
    EXPECT_EQ(read_at_most(folder.file("text", text), text.size()), text);
    const auto refusal = [](const std::filesystem::path& file, std::size_t most) {
        return test::error_of([&] { (void)read_at_most(file, most); });
    };
    EXPECT_THAT(refusal(folder / "text", text.size() - 1), HasSubstr("text: has more than 99999 bytes"));
    EXPECT_THAT(refusal("/dev/zero", 1'000'000), HasSubstr("/dev/zero: is a pipe, socket or device"));
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    EXPECT_THAT(refusal(folder / "pipe", 10), HasSubstr("pipe: is a pipe, socket or device; give a file"));
    EXPECT_THAT(refusal(folder / "none", 10), HasSubstr("none: does not exist; check the name"));
    EXPECT_THAT(refusal(folder.path(), 10), HasSubstr(": is a folder; give a file"));
    EXPECT_THAT(test::error_of([&] { (void)read_bytes(folder.path()); }),
                HasSubstr("is a folder; give a file"));
    EXPECT_THAT(test::error_of([&] { (void)read_bytes(std::string(5000, 'a')); }),
                HasSubstr("name too long"));
}

TEST(InputFile, LargerThanTheMemoryIsRefusedBeforeItIsRead) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.file("sparse", "");
    std::error_code no_such_size;
    std::filesystem::resize_file(file, std::uintmax_t{1} << 42U, no_such_size);
    if (no_such_size) GTEST_SKIP() << "this file system has no file of 4 TB";
    EXPECT_THAT(test::error_of([&] { (void)read_bytes(file); }),
                HasSubstr("sparse: its content needs 4.4e+03 GB of memory"));
}

TEST(InputFile, KnowsWhetherALinkLeadsOutOfAFolder) {
    const TemporaryFolder folder;
    const TemporaryFolder other;
    std::filesystem::create_symlink(other.file("secret", "text"), folder / "out");
    std::filesystem::create_symlink("inner/there", folder / "in");
    (void)folder.file("inner/there", "text");
    EXPECT_TRUE(InputFile(folder / "in").is_beneath(folder.path()));
    EXPECT_TRUE(InputFile(folder / "inner/there").is_beneath(folder / "inner"));
    EXPECT_FALSE(InputFile(folder / "in").is_beneath(folder / "out"));
    EXPECT_FALSE(InputFile(folder / "out").is_beneath(folder.path()));
}

}  // namespace
}  // namespace samara
