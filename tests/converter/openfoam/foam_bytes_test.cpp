#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "converter/openfoam/foam_scanner.hpp"
#include "gzip.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using testing::EndsWith;

/// Ten lines of text repeated, which packs well, after noise, which does not.
std::string long_text() {
    std::string text;
    unsigned state = 1;
    for (int i = 0; i < 300000; ++i) {
        state = state * 1664525U + 1013904223U;
        text += static_cast<char>(state >> 24);
    }
    for (int i = 0; i < 200000; ++i) text += "a field of zeros 0 0 0 0\n";
    return text;
}

class FoamBytesOfAFile : public testing::Test {
  protected:
    std::string error_of(const std::string& packed) const {
        const std::filesystem::path file = folder_.file("k.gz", packed);
        std::string message = test::error_of([&] { read_foam_bytes(folder_.path() / "k"); });
        EXPECT_EQ(message.find(file.string() + ": "), 0U);
        EXPECT_THAT(message, EndsWith("; copy the file again, or write it again with OpenFOAM"));
        return message.substr(file.string().size() + 2, message.find(';') - file.string().size() - 2);
    }

    test::TemporaryFolder folder_;
};

TEST_F(FoamBytesOfAFile, AreThoseOfThePlainFileWhereThereIsOne) {
    const std::filesystem::path plain = folder_.file("k", "plain");
    static_cast<void>(folder_.file("k.gz", test::gzipped("packed")));
    EXPECT_TRUE(foam_file_exists(plain));
    EXPECT_EQ(read_foam_bytes(plain).text, "plain");
    EXPECT_EQ(read_foam_bytes(plain).path, plain);
}

TEST_F(FoamBytesOfAFile, AreUnpackedWhereOnlyThePackedFileIsThere) {
    const std::string text = long_text();
    const std::filesystem::path packed = folder_.file("k.gz", test::gzipped(text));
    const FoamBytes bytes = read_foam_bytes(folder_.path() / "k");
    EXPECT_EQ(bytes.path, packed);
    EXPECT_EQ(bytes.text, text);
    EXPECT_TRUE(foam_file_exists(folder_.path() / "k"));
    EXPECT_FALSE(foam_file_exists(folder_.path() / "epsilon"));
}

TEST_F(FoamBytesOfAFile, OfJoinedGzipFilesFollowOneAnother) {
    static_cast<void>(folder_.file("k.gz", test::gzipped("one ") + test::gzipped(long_text())));
    EXPECT_EQ(read_foam_bytes(folder_.path() / "k").text, "one " + long_text());
}

TEST_F(FoamBytesOfAFile, AreRejectedWhereverAPackedFileIsCutShort) {
    const std::string packed = test::gzipped("internalField uniform 1;");
    for (std::size_t length = 2; length < packed.size(); ++length) {
        EXPECT_EQ(error_of(packed.substr(0, length)), "the compressed file is truncated") << length;
    }
    EXPECT_EQ(error_of(test::gzipped(long_text()).substr(0, 200000)), "the compressed file is truncated");
}

TEST_F(FoamBytesOfAFile, AreRejectedWhereAPackedFileIsDamagedOrForeign) {
    std::string packed = test::gzipped(long_text());
    packed[packed.size() / 2] = static_cast<char>(packed[packed.size() / 2] ^ 1);
    EXPECT_EQ(error_of(packed), "the compressed file is damaged");
    EXPECT_EQ(error_of(test::gzipped("k") + "garbage after it"), "the compressed file is damaged");
    EXPECT_EQ(error_of("internalField uniform 1;"), "is not compressed with gzip");
    EXPECT_EQ(error_of(""), "is not compressed with gzip");
}

}  // namespace
}  // namespace samara
