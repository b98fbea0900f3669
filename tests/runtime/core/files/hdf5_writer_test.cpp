#include "samara/core/files/hdf5_writer.hpp"

#include <chrono>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using test::error_of;
using testing::ElementsAre;
using testing::HasSubstr;

void write_sample(const std::filesystem::path& file) {
    write_hdf5(file, [](Hdf5Writer& writer) {
        writer.write("/a/doubles", std::vector<double>{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}, {2, 3}, "m", "lengths");
        writer.write("/a/integers", std::vector<std::int32_t>{7, -8}, {2}, "1", "numbers");
        writer.write("/a/none", std::vector<double>{}, {0, 3}, "m", "no rows");
        writer.write_text("/a/b/text", "caf\xc3\xa9\n", "a text");
        writer.attribute("/a", "word", std::string_view("x y"));
        writer.attribute("/a", "empty", std::string_view());
        writer.attribute("/a", "number", 0.1);
        writer.attribute("/a", "count", std::int64_t{-3});
    });
}

TEST(Hdf5Writer, GivesBackWhatWasWritten) {
    const test::TemporaryFolder folder;
    write_sample(folder / "a.h5");
    const Hdf5Reader reader(folder / "a.h5");
    EXPECT_THAT(reader.finite_doubles("/a/doubles", {0, 3}), ElementsAre(1.0, 2.0, 3.0, 4.0, 5.0, 6.0));
    EXPECT_THAT(reader.integers("/a/integers", {2}), ElementsAre(7, -8));
    EXPECT_TRUE(reader.finite_doubles("/a/none", {0, 3}).empty());
    EXPECT_EQ(reader.text("/a/b/text"), "caf\xc3\xa9\n");
    EXPECT_EQ(reader.text_attribute("/a", "word"), "x y");
    EXPECT_EQ(reader.text_attribute("/a", "empty"), "");
    EXPECT_EQ(reader.number_attribute("/a", "number"), 0.1);
    EXPECT_EQ(reader.integer_attribute("/a", "count"), -3);
    EXPECT_THAT(reader.children("/a"), ElementsAre("b", "doubles", "integers", "none"));
    EXPECT_THAT(reader.shape("/a/doubles"), ElementsAre(2, 3));
    EXPECT_TRUE(reader.has("/a/b/text"));
    EXPECT_FALSE(reader.has("/a/c/text"));
}

TEST(Hdf5Writer, EqualContentGivesEqualBytesAtAnotherTime) {
    const test::TemporaryFolder folder;
    write_sample(folder / "a.h5");
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // HDF5 counts its times in seconds
    write_sample(folder / "b.h5");
    EXPECT_EQ(file_content_hash(folder / "a.h5"), file_content_hash(folder / "b.h5"));
}

TEST(Hdf5Writer, HoldsNoTimes) {
    const test::TemporaryFolder folder;
    write_sample(folder / "a.h5");
    const H5::H5File file((folder / "a.h5").string(), H5F_ACC_RDONLY);
    for (const char* object : {"/", "/a", "/a/b", "/a/doubles"}) {
        H5O_info_t info;
        ASSERT_GE(H5Oget_info_by_name(file.getId(), object, &info, H5P_DEFAULT), 0);
        EXPECT_EQ(info.mtime, 0) << object;
        EXPECT_EQ(info.btime, 0) << object;
    }
}

}  // namespace
}  // namespace samara
