#include "samara/core/files/content_hash.hpp"

#include <H5Cpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/hdf5_writer.hpp"
#include "samara/core/files/replace_file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using test::error_of;
using testing::HasSubstr;

class FileDigest : public testing::Test {
  protected:
    void SetUp() override {
        write_hdf5(file_, [](Hdf5Writer& writer) {
            // Bytes whose change from 0000 to ffff fletcher32 does not see.
            writer.write("/zeros", std::vector<double>(1000), {1000}, "1", "");
        });
        bytes_ = read_bytes(file_);
    }
    [[nodiscard]] std::string error_of_bytes(const std::string& bytes) const {
        replace_file_with(folder_ / "b.h5", bytes);
        return error_of([&] { const Hdf5Reader reader(folder_ / "b.h5"); });
    }

    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "a.h5";
    std::string bytes_;
};

TEST_F(FileDigest, IsTheHashOfAllBytesBeforeIt) {
    const std::string content = bytes_.substr(0, bytes_.size() - 48);
    EXPECT_EQ(bytes_.substr(content.size()), "\nsamara xxh128 " + content_hash(content) + "\n");
    EXPECT_TRUE(Hdf5Reader(file_).has_digest());
}

TEST_F(FileDigest, SeesWhatFletcher32DoesNot) {
    const H5::H5File file(file_.string(), H5F_ACC_RDONLY);
    const hsize_t start[1] = {0};
    haddr_t place = 0;
    hsize_t size = 0;
    ASSERT_GE(H5Dget_chunk_info_by_coord(file.openDataSet("/zeros").getId(), start, nullptr, &place, &size),
              0);
    std::string damaged = bytes_;
    damaged[place] = damaged[place + 1] = '\xff';
    EXPECT_THAT(error_of_bytes(damaged),
                HasSubstr("b.h5: is damaged (its digest does not match its content)"));
    // Without the digest the change passes.
    replace_file_with(folder_ / "c.h5", damaged.substr(0, damaged.size() - 48));
    const Hdf5Reader reader(folder_ / "c.h5");
    EXPECT_FALSE(reader.has_digest());
    EXPECT_NE(H5Fis_hdf5((folder_ / "c.h5").c_str()), 0);
}

TEST_F(FileDigest, EveryFlippedBitIsFound) {
    for (std::size_t place = 0; place < bytes_.size(); place += 7) {
        std::string damaged = bytes_;
        damaged[place] = static_cast<char>(damaged[place] ^ static_cast<char>(1U << (place % 8)));
        EXPECT_THAT(error_of_bytes(damaged), HasSubstr("b.h5")) << place;
    }
}

TEST_F(FileDigest, EveryLengthButThatOfTheContentIsRefused) {
    const std::size_t content = bytes_.size() - 48;
    for (std::size_t cut = 1; cut < 200; ++cut) {
        if (bytes_.size() - cut == content) continue;
        EXPECT_THAT(error_of_bytes(bytes_.substr(0, bytes_.size() - cut)), HasSubstr("b.h5")) << cut;
    }
    EXPECT_THAT(error_of_bytes(bytes_ + std::string(4096, '\0')), HasSubstr("has bytes after its content"));
}

TEST_F(FileDigest, IsGoneWhenAnotherProgramChangesTheFile) {
    { const H5::Group made = H5::H5File(file_.string(), H5F_ACC_RDWR).createGroup("/note"); }
    const Hdf5Reader reader(file_);
    EXPECT_FALSE(reader.has_digest());
    EXPECT_EQ(reader.finite_doubles("/zeros", {0}).size(), 1000U);
}

TEST_F(FileDigest, OfALongFileIsThatOfAllItsParts) {
    const std::filesystem::path file = folder_.file("long", std::string((3U << 20U) + 5, 'x'));
    EXPECT_FALSE(has_digest(InputFile(file)));
    append_digest(file);
    EXPECT_TRUE(verify_digest(InputFile(file)));
    const std::string bytes = read_bytes(file);
    EXPECT_THAT(bytes, HasSubstr(content_hash(bytes.substr(0, bytes.size() - 48))));
}

}  // namespace
}  // namespace samara
