#include "samara/core/files/hdf5_reader.hpp"

#include <cstdlib>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "samara/core/files/hdf5_writer.hpp"
#include "support/crafted_hdf5.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using test::error_of;
using test::in_chunks;
using test::put_attribute;
using test::put_dataset;
using testing::HasSubstr;

/// A sound file, which each test spoils.
class Hdf5ReaderTest : public testing::Test {
  protected:
    void SetUp() override {
        write_hdf5(file_, [](Hdf5Writer& writer) {
            writer.write("/a/doubles", std::vector<double>{1.0, 2.0, 3.0, 4.0, 5.0, 6.0}, {2, 3}, "m", "");
            writer.write("/a/corners", std::vector<std::int32_t>{0, 1, 2}, {1, 3}, "1", "");
            writer.write_text("/a/text", "a scene", "");
            writer.attribute("/a", "word", std::string_view("x y"));
            writer.attribute("/a", "number", 0.1);
            writer.attribute("/a", "count", std::int64_t{-3});
        });
    }

    [[nodiscard]] std::string error_of_doubles() const {
        return error_of([&] { (void)Hdf5Reader(file_).finite_doubles("/a/doubles", {0, 3}); });
    }
    [[nodiscard]] std::string error_of_corners() const {
        return error_of([&] { (void)Hdf5Reader(file_).integers("/a/corners", {0, 3}); });
    }
    [[nodiscard]] std::string error_of_text() const {
        return error_of([&] { (void)Hdf5Reader(file_).text("/a/text"); });
    }

    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "a.h5";
    std::filesystem::path other_ = folder_ / "other.h5";
};

TEST_F(Hdf5ReaderTest, NamesWhatDoesNotFit) {
    const Hdf5Reader reader(file_);
    EXPECT_THAT(error_of([&] {
                    (void)reader.finite_doubles("/a/doubles", {0, 4});
                }),
                HasSubstr("/a/doubles has the shape"));
    EXPECT_THAT(error_of([&] { (void)reader.finite_doubles("/a/missing", {0}); }),
                HasSubstr("/a/missing is missing"));
    EXPECT_THAT(error_of([&] { (void)reader.integers("/a/doubles", {0, 3}); }), HasSubstr("another type"));
    EXPECT_THAT(error_of([&] {
                    (void)reader.finite_doubles("/a/corners", {0, 3});
                }),
                HasSubstr("another type"));
    EXPECT_THAT(error_of([&] { (void)reader.finite_doubles("/a", {0}); }), HasSubstr("/a is not a dataset"));
    EXPECT_THAT(error_of([&] { (void)reader.number_attribute("/a", "missing"); }), HasSubstr("missing"));
    EXPECT_THAT(error_of([&] { (void)reader.integer_attribute("/a", "number"); }),
                HasSubstr("not an integer"));
    EXPECT_THAT(error_of([&] { (void)reader.number_attribute("/a", "word"); }), HasSubstr("not a number"));
    EXPECT_THAT(error_of([&] { (void)reader.text_attribute("/a", "number"); }), HasSubstr("not a string"));
    EXPECT_THAT(error_of([&] { (void)reader.children("/c"); }), HasSubstr("/c is missing"));
    EXPECT_THAT(error_of([&] { (void)reader.children("/a/text"); }), HasSubstr("/a/text is not a group"));
}

TEST_F(Hdf5ReaderTest, AnAttributeOfManyNumbersIsRefused) {
    const auto rejected = [&](const H5::PredType& type, hsize_t count) {
        put_attribute(file_, "/a", "x", type, count);
        const Hdf5Reader reader(file_);
        const std::string wanted = "the attribute x of /a is not a single value";
        EXPECT_THAT(error_of([&] { (void)reader.number_attribute("/a", "x"); }), HasSubstr(wanted));
        if (type.getClass() == H5T_FLOAT) return;
        EXPECT_THAT(error_of([&] { (void)reader.integer_attribute("/a", "x"); }), HasSubstr(wanted));
        EXPECT_THAT(error_of([&] { (void)reader.unsigned_attribute("/a", "x"); }), HasSubstr(wanted));
    };
    for (const hsize_t count : {0U, 2U, 64U, 4000U}) {
        rejected(H5::PredType::IEEE_F64LE, count);
        rejected(H5::PredType::STD_I64LE, count);
    }
}

TEST_F(Hdf5ReaderTest, ANumberThatIsNoPlainOneIsRefused) {
    H5::FloatType wide(H5::PredType::IEEE_F64LE);
    wide.setSize(4096);
    H5::IntType narrow(H5::PredType::STD_I64LE);
    narrow.setPrecision(17);
    const H5::ArrayType array(H5::PredType::IEEE_F64LE, 1, std::vector<hsize_t>{64}.data());
    for (const H5::DataType& type : std::vector<H5::DataType>{wide, narrow, array}) {
        put_attribute(file_, "/a", "x", type, 1);
        EXPECT_THAT(error_of([&] { (void)Hdf5Reader(file_).number_attribute("/a", "x"); }),
                    HasSubstr("is not a number"));
        put_dataset(file_, "/a/doubles", type, {2, 3});
        EXPECT_THAT(error_of_doubles(), HasSubstr("another type"));
    }
}

TEST_F(Hdf5ReaderTest, AnAttributeOfManyTextsOrOfVariableLengthIsRefused) {
    const auto error = [&](const H5::StrType& type, hsize_t count) {
        put_attribute(file_, "/a", "x", type, count);
        return error_of([&] { (void)Hdf5Reader(file_).text_attribute("/a", "x"); });
    };
    const H5::StrType text(H5::PredType::C_S1, 10);
    EXPECT_THAT(error(text, 3), HasSubstr("is not a single value"));
    EXPECT_THAT(error(text, 0), HasSubstr("is not a single value"));
    EXPECT_THAT(error(H5::StrType(H5::PredType::C_S1, H5T_VARIABLE), 1), HasSubstr("fixed length"));
}

TEST_F(Hdf5ReaderTest, AnArrayOfOneValueReadsAsTheValue) {
    put_attribute(file_, "/a", "x", H5::PredType::IEEE_F32BE, 1);
    put_attribute(file_, "/a", "y", H5::StrType(H5::PredType::C_S1, 10), 1);
    EXPECT_EQ(Hdf5Reader(file_).number_attribute("/a", "x"), 0.0);
    EXPECT_EQ(Hdf5Reader(file_).text_attribute("/a", "y"), "");
}

TEST_F(Hdf5ReaderTest, AShapeThat64BitsDoNotCountIsRefused) {
    for (const hsize_t rows : {hsize_t{1} << 62U, hsize_t{1} << 61U, hsize_t{6148914691236517206}}) {
        put_dataset(file_, "/a/corners", H5::PredType::STD_I32LE, {rows, 3}, in_chunks({1, 3}));
        EXPECT_THAT(error_of_corners(), HasSubstr("/a/corners declares too many values")) << rows;
    }
}

TEST_F(Hdf5ReaderTest, ValuesThatAreNotStoredAreRefused) {
    put_dataset(file_, "/a/doubles", H5::PredType::IEEE_F64LE, {1'000'000'000, 3}, in_chunks({1000, 3}));
    EXPECT_THAT(error_of_doubles(), HasSubstr("/a/doubles declares values that are not stored"));
    put_dataset(file_, "/a/doubles", H5::PredType::IEEE_F64LE, {1'000'000'000, 3});
    EXPECT_THAT(error_of_doubles(), HasSubstr("/a/doubles declares values that are not stored"));
    put_dataset(file_, "/a/text", H5::PredType::STD_U8LE, {24'000'000'000}, in_chunks({1U << 20U}));
    EXPECT_THAT(error_of_text(), HasSubstr("/a/text declares values that are not stored"));
}

TEST_F(Hdf5ReaderTest, DatasetsTogetherHoldNoMoreThanTheFile) {
    write_hdf5(file_, [](Hdf5Writer& writer) {
        writer.write("/a/large", std::vector<double>(10'000), {10'000}, "1", "");
    });
    {
        const H5::H5File file(file_.string(), H5F_ACC_RDWR);
        H5Lcreate_hard(file.getId(), "/a/large", file.getId(), "/a/again", H5P_DEFAULT, H5P_DEFAULT);
    }
    const Hdf5Reader reader(file_);
    EXPECT_EQ(reader.finite_doubles("/a/large", {0}).size(), 10'000U);
    EXPECT_EQ(reader.finite_doubles("/a/large", {0}).size(), 10'000U);
    EXPECT_THAT(error_of([&] { (void)reader.finite_doubles("/a/again", {0}); }),
                HasSubstr("/a/again declares more bytes than the file has"));
}

TEST_F(Hdf5ReaderTest, ValuesOfOtherFilesAreRefused) {
    write_hdf5(other_, [](Hdf5Writer& writer) {
        writer.write("/secret", std::vector<double>(6), {2, 3}, "1", "");
    });
    ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    for (const char* other : {"other.h5", "pipe"}) {
        put_dataset(file_, "/a/doubles", H5::PredType::IEEE_F64LE, {2, 3},
                    test::in_other_file(folder_ / other, 48));
        EXPECT_THAT(error_of_doubles(), HasSubstr("/a/doubles is stored in other files"));
        put_dataset(file_, "/a/text", H5::PredType::STD_U8LE, {7}, test::in_other_file(folder_ / other, 7));
        EXPECT_THAT(error_of_text(), HasSubstr("/a/text is stored in other files"));
        put_dataset(file_, "/a/doubles", H5::PredType::IEEE_F64LE, {2, 3},
                    test::in_dataset_of(folder_ / other, "/secret", {2, 3}));
        EXPECT_THAT(error_of_doubles(), HasSubstr("/a/doubles is stored in other files"));
    }
}

TEST_F(Hdf5ReaderTest, LinksAreNotFollowed) {
    write_hdf5(other_, [](Hdf5Writer& writer) {
        writer.write("/a/doubles", std::vector<double>(6), {2, 3}, "1", "");
        writer.attribute("/a", "number", 1.0);
    });
    ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    for (const char* other : {"other.h5", "pipe"}) {
        test::put_link(file_, "/a/doubles", "/a/doubles", folder_ / other);
        EXPECT_THAT(error_of_doubles(), HasSubstr("/a/doubles is an external link"));
        test::put_link(file_, "/b", "/a", folder_ / other);
        const Hdf5Reader reader(file_);
        EXPECT_THAT(error_of([&] {
                        (void)reader.finite_doubles("/b/doubles", {2, 3});
                    }),
                    HasSubstr("/b is an external link"));
        EXPECT_THAT(error_of([&] { (void)reader.number_attribute("/b", "number"); }),
                    HasSubstr("/b is an external link"));
        EXPECT_THAT(error_of([&] { (void)reader.children("/b"); }), HasSubstr("/b is an external link"));
    }
    test::put_link(file_, "/a/doubles", "/a/doubles");  // to itself
    EXPECT_THAT(error_of_doubles(), HasSubstr("/a/doubles is an external link"));
}

TEST_F(Hdf5ReaderTest, CompressedValuesAreRefused) {
    H5::DSetCreatPropList creation = in_chunks({2, 3});
    creation.setDeflate(9);
    put_dataset(file_, "/a/doubles", H5::PredType::IEEE_F64LE, {2, 3}, creation);
    EXPECT_THAT(error_of_doubles(), HasSubstr("/a/doubles is compressed or encoded"));
}

TEST_F(Hdf5ReaderTest, EdgesOfChunksWithoutTheirFilterAreRefused) {
    H5::DSetCreatPropList creation = in_chunks({2, 2});
    creation.setFletcher32();
    H5Pset_chunk_opts(creation.getId(), H5D_CHUNK_DONT_FILTER_PARTIAL_CHUNKS);
    put_dataset(file_, "/a/doubles", H5::PredType::IEEE_F64LE, {2, 3}, creation);
    EXPECT_THAT(error_of_doubles(), HasSubstr("/a/doubles is compressed or encoded"));
}

/// 64 rows of 8 doubles in chunks of 64 or 32, with or without checksums, of which none, one or two axes may
/// grow, in HDF5's latest format or its oldest.
class CraftedChunks : public testing::TestWithParam<std::tuple<hsize_t, bool, std::size_t, bool>> {
  protected:
    void SetUp() override { ASSERT_TRUE(make({})); }

    [[nodiscard]] bool make(const std::vector<test::CraftedChunk>& crafted) const {
        test::make_hdf5(file_, {64, 8}, std::get<3>(GetParam()));
        return test::put_in_chunks(file_, "/values", {{rows(), 8}, has_checksum(), std::get<2>(GetParam())},
                                   crafted);
    }

    static hsize_t rows() { return std::get<0>(GetParam()); }
    static bool has_checksum() { return std::get<1>(GetParam()); }
    /// What a chunk's values take in the file, without and with their checksum.
    static std::size_t plain_bytes() { return static_cast<std::size_t>(rows()) * 8 * sizeof(double); }
    static std::size_t whole_bytes() { return plain_bytes() + (has_checksum() ? 4 : 0); }
    static bool has_second() { return rows() == 32; }

    [[nodiscard]] std::vector<double> read() const {
        return Hdf5Reader(file_).finite_doubles("/values", {0, 8});
    }

    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "a.h5";
};

INSTANTIATE_TEST_SUITE_P(EachIndex, CraftedChunks,
                         testing::Combine(testing::Values(64, 32), testing::Bool(), testing::Values(0, 1, 2),
                                          testing::Bool()));

TEST_P(CraftedChunks, OfTheirOwnSizeAreRead) {
    const std::vector<double> values = read();
    ASSERT_EQ(values.size(), 512U);
    EXPECT_EQ(values.back(), 512.0);
}

TEST_P(CraftedChunks, OfAnotherSizeAreNeverReadPastTheirEnd) {
    const std::size_t plain = plain_bytes();
    const std::size_t whole = whole_bytes();
    for (const std::size_t bytes : std::vector<std::size_t>{1, 2, 3, 4, 5, 16, plain - 8, plain - 1, plain,
                                                            whole, plain + 3, plain + 5, 2 * plain}) {
        for (const std::uint32_t mask : {0U, 1U}) {
            std::vector<test::CraftedChunk> crafted = {{{0, 0}, bytes, mask}};
            // So that what is stored is in sum what it should be.
            if (has_second() && bytes < 2 * whole) crafted.push_back({{32, 0}, 2 * whole - bytes, 1});
            if (bytes == whole && (mask == 0 || !has_checksum())) continue;
            if (!make(crafted)) continue;
            if (has_checksum()) {
                EXPECT_THAT(error_of([&] { (void)read(); }), HasSubstr("/values"))
                    << bytes << " bytes, mask " << mask;
                continue;
            }
            try {  // HDF5 may take such values from where they stand
                EXPECT_EQ(read().size(), 512U);
            } catch (const Error& error) {
                EXPECT_THAT(error.what(), HasSubstr("/values")) << bytes;
            }
        }
    }
}

TEST_P(CraftedChunks, ThatWereNeverWrittenAreRefused) {
    H5::DSetCreatPropList creation = in_chunks({rows(), 8});
    if (has_checksum()) creation.setFletcher32();
    put_dataset(file_, "/values", H5::PredType::IEEE_F64LE, {64, 8}, creation);
    EXPECT_THAT(error_of([&] { (void)read(); }), HasSubstr("/values declares values that are not stored"));
}

TEST_F(Hdf5ReaderTest, JsonThatNestsTooDeepIsRefused) {
    test::put_text(file_, "/a/text", std::string(101, '[') + std::string(101, ']'));
    EXPECT_THAT(error_of([&] { (void)Hdf5Reader(file_).json_text("/a/text"); }),
                HasSubstr("/a/text nests lists and objects more than 100 deep"));
    const std::string text = R"({"text": "[[[[", "list": [1]})";
    test::put_text(file_, "/a/text", text);
    EXPECT_EQ(Hdf5Reader(file_).json_text("/a/text"), text);
}

TEST_F(Hdf5ReaderTest, HasEachFileCheckedOnceThatThisProcessDidNotWrite) {
    std::filesystem::copy_file(file_, other_);
    static int checks = 0;
    Hdf5Reader::set_check([](const InputFile& file) {
        ++checks;
        if (file.size() < 100) throw Error("checked");
    });
    { const Hdf5Reader own(file_); }
    EXPECT_EQ(checks, 0);
    { const Hdf5Reader first(other_); }
    { const Hdf5Reader second(other_); }
    EXPECT_EQ(checks, 1);
    (void)folder_.file("other.h5", "text");
    EXPECT_EQ(error_of([&] { const Hdf5Reader third(other_); }), "checked");
    EXPECT_EQ(checks, 2);
    Hdf5Reader::set_check(nullptr);
    EXPECT_THAT(error_of([&] { const Hdf5Reader fourth(other_); }), HasSubstr("is not an HDF5 file"));
}

TEST_F(Hdf5ReaderTest, WhatIsNoFileIsRefusedWithoutWaiting) {
    ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    const auto error = [](const std::filesystem::path& path) {
        return error_of([&] { const Hdf5Reader reader(path); });
    };
    EXPECT_THAT(error(folder_ / "pipe"), HasSubstr("pipe: is a pipe, socket or device; give a file"));
    EXPECT_THAT(error("/dev/zero"), HasSubstr("/dev/zero: is a pipe, socket or device; give a file"));
    EXPECT_THAT(error(folder_.path()), HasSubstr("is a folder; give a file"));
    EXPECT_THAT(error(folder_ / "none.h5"), HasSubstr("none.h5: does not exist; check the name"));
    EXPECT_THAT(error(file_ / "below.h5"), HasSubstr("cannot be read: Not a directory"));
}

TEST_F(Hdf5ReaderTest, AFileThatMayNotBeReadSaysSo) {
    const auto error = [&] {
        if (::geteuid() == 0 && ::seteuid(65534) != 0) return std::string("no other user");
        return error_of([&] { const Hdf5Reader reader(file_); });
    };
    ASSERT_EQ(::chmod(file_.c_str(), 0), 0);
    EXPECT_EXIT(std::_Exit(error() == file_.string() + ": cannot be read: Permission denied" ? 0 : 1),
                testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace samara
