// Body and motion files made by a stranger to harm their reader, through every reader.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "c_interface_calls.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/hdf5_writer.hpp"
#include "samara/motion/motion_file.hpp"
#include "support/crafted_hdf5.hpp"
#include "support/expect_error.hpp"
#include "support/program_run.hpp"
#include "support/test_shapes.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::error_of;
using test::in_chunks;
using test::ProgramRun;
using test::put_attribute;
using test::put_dataset;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class CraftedBody : public testing::Test {
  protected:
    void SetUp() override { write_body_file(file_, test::full_body()); }

    /// Whether the reader, the commands and the C interface reject the file with one line that says `what`.
    void expect_rejection(const std::string& what) const {
        EXPECT_THAT(error_of([&] { (void)read_body_file(file_); }), HasSubstr(what));
        samara_body* loaded = nullptr;
        test::Text error;
        EXPECT_EQ(CALL(samara_body_load, file_.c_str(), &loaded), SAMARA_UNREADABLE_FILE);
        EXPECT_THAT(error.text(), AllOf(HasSubstr(what), Not(HasSubstr("\n"))));
        for (const std::vector<std::string>& words :
             std::vector<std::vector<std::string>>{{"samara", "info", "a.body.h5"},
                                                   {"samara", "info", "a.body.h5", "--json"},
                                                   {"samara", "check", "a.body.h5"},
                                                   {"samara", "mass", "a.body.h5", "--density", "1200"},
                                                   {"samara", "kirchhoff", "a.body.h5"},
                                                   {"samara", "plot", "a.body.h5", "-o", "a.svg"},
                                                   {"samara", "report", "a.body.h5", "-o", "a.html"},
                                                   {"samara", "simulate", "scene.toml", "-o", "out.h5"}}) {
            const ProgramRun done = run_program_in(folder_, words);
            EXPECT_EQ(done.status, 1) << words[1];
            EXPECT_TRUE(test::is_one_line(done.error)) << done.error;
            EXPECT_THAT(done.error, HasSubstr(what)) << words[1];
        }
    }

    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "a.body.h5";
    std::filesystem::path scene_ =
        folder_.file("scene.toml",
                     "[scene]\nduration = 0.01\n[fluid]\npreset = \"water\"\n[[body]]\nname = \"a\"\n"
                     "shape = \"a.body.h5\"\ndensity = 1200\n");
};

TEST_F(CraftedBody, AnAttributeOfManyNumbersIsRefusedEverywhere) {
    put_attribute(file_, "/moments", "volume", H5::PredType::IEEE_F64LE, 64);
    expect_rejection("the attribute volume of /moments is not a single value");
    write_body_file(file_, test::full_body());
    put_attribute(file_, "/tables", "subdivisions", H5::PredType::STD_I64LE, 4000);
    expect_rejection("the attribute subdivisions of /tables is not a single value");
    write_body_file(file_, test::full_body());
    put_attribute(file_, "/", "name", H5::StrType(H5::PredType::C_S1, 1000), 8);
    expect_rejection("the attribute name of / is not a single value");
}

TEST_F(CraftedBody, RowsThat64BitsDoNotCountAreRefusedEverywhere) {
    put_dataset(file_, "/surface/corners", H5::PredType::STD_I32LE, {6148914691236517206, 3},
                in_chunks({1, 3}));
    expect_rejection("/surface/corners declares too many values");
}

TEST_F(CraftedBody, TablesThatClaimGigabytesAreRefusedEverywhere) {
    put_dataset(file_, "/tables/force", H5::PredType::IEEE_F64LE, {1'000'000, 31, 31, 3},
                in_chunks({1, 31, 31, 3}));
    expect_rejection("/tables/force declares values that are not stored");
    // The other case: few bytes for the numbers, and a map that multiplies them.
    Body body = test::full_body();
    body.tables->reynolds_numbers.resize(20'000);
    for (std::size_t i = 0; i < 20'000; ++i) {
        body.tables->reynolds_numbers[i] = 1.0 + static_cast<double>(i);
    }
    body.tables->subdivisions = 1;
    body.tables->entries.resize(std::size_t{20'000} * 9);
    body.tables->errors.resize(std::size_t{20'000} * 9);
    write_body_file(file_, body);
    {
        const H5::H5File file(file_.string(), H5F_ACC_RDWR);
        const std::int64_t subdivisions = 1024;
        file.openGroup("/tables")
            .openAttribute("subdivisions")
            .write(H5::PredType::NATIVE_INT64, &subdivisions);
    }
    expect_rejection("/tables/force has the shape");
}

TEST_F(CraftedBody, AnotherFileIsNotReadThroughIt) {
    const std::string secret = "the secret of another file";
    (void)folder_.file("secret", secret);
    put_dataset(file_, "/tables/provenance", H5::PredType::STD_U8LE, {secret.size()},
                test::in_other_file(folder_ / "secret", secret.size()));
    expect_rejection("/tables/provenance is stored in other files");
}

TEST_F(CraftedBody, AChunkShorterThanItsValuesIsRefusedEverywhere) {
    constexpr std::size_t whole = 75 * 8 + 4;
    ASSERT_TRUE(test::put_in_chunks(file_, "/tables/force", {.chunk = {1, 5, 5, 3}},
                                    {{{0, 0, 0, 0}, 16, 1}, {{1, 0, 0, 0}, 2 * whole - 16, 1}}));
    expect_rejection("/tables/force has a chunk whose size does not match its values");
}

TEST_F(CraftedBody, JsonThatNestsTooDeepIsRefusedEverywhere) {
    for (const char* name : {"/tables/provenance", "/tables/plan", "/tables/left_out"}) {
        write_body_file(file_, test::full_body());
        test::put_text(file_, name, "[" + std::string(500'000, '[') + std::string(500'000, ']') + "]");
        expect_rejection(std::string(name) + " nests lists and objects more than 100 deep");
    }
}

class CraftedMotion : public testing::Test {
  protected:
    void SetUp() override {
        write_motion_file(file_, test::motion_of([](double t) { return test::tumble(t, 1.0, 1.0); }, 1.0));
    }

    void expect_rejection(const std::string& what) const {
        EXPECT_THAT(error_of([&] { (void)read_motion_file(file_); }), HasSubstr(what));
        for (const std::vector<std::string>& words :
             std::vector<std::vector<std::string>>{{"samara", "info", "a.h5"},
                                                   {"samara", "info", "a.h5", "--json"},
                                                   {"samara", "check", "a.h5"},
                                                   {"samara", "export", "a.h5", "-o", "a.glb"},
                                                   {"samara", "export", "a.h5", "-o", "a.csv"},
                                                   {"samara", "plot", "a.h5", "-o", "a.svg"},
                                                   {"samara", "compare", "a.h5", "a.h5"}}) {
            const ProgramRun done = run_program_in(folder_, words);
            EXPECT_EQ(done.status, 1) << words[1];
            EXPECT_TRUE(test::is_one_line(done.error)) << done.error;
            EXPECT_THAT(done.error, HasSubstr(what)) << words[1];
            EXPECT_FALSE(std::filesystem::exists(folder_ / "a.csv"));
        }
    }

    test::TemporaryFolder folder_;
    std::filesystem::path file_ = folder_ / "a.h5";
};

TEST_F(CraftedMotion, AnotherFileIsNeitherPrintedNorWaitedFor) {
    (void)folder_.file("secret", "the secret of another file");
    ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
    for (const char* other : {"secret", "pipe"}) {
        put_dataset(file_, "/scene", H5::PredType::STD_U8LE, {26}, test::in_other_file(folder_ / other, 26));
        expect_rejection("/scene is stored in other files");
        test::put_link(file_, "/scene", "/scene", folder_ / other);
        expect_rejection("/scene is an external link");
    }
}

TEST_F(CraftedMotion, AttributesOfManyNumbersAreRefusedEverywhere) {
    put_attribute(file_, "/", "seed", H5::PredType::STD_U64LE, 64);
    expect_rejection("the attribute seed of / is not a single value");
    put_attribute(file_, "/", "frame_rate", H5::PredType::IEEE_F64LE, 64);
    expect_rejection("the attribute frame_rate of / is not a single value");
}

TEST_F(CraftedMotion, AChunkOfAnotherSizeThanItsValuesIsRefusedEverywhere) {
    const std::string name = "/bodies/ellipsoid/position";
    constexpr std::size_t whole = 31 * 3 * 8 + 4;
    for (const auto& [bytes, mask] : {std::pair<std::size_t, std::uint32_t>{2, 0}, {16, 1}}) {
        ASSERT_TRUE(
            test::put_in_chunks(file_, name, {.chunk = {1, 31, 1, 3}},
                                {{{0, 0, 0, 0}, bytes, mask}, {{0, 31, 0, 0}, 2 * whole - bytes, 1}}));
        expect_rejection(name + " has a chunk whose size does not match its values");
        SetUp();
    }
}

TEST_F(CraftedMotion, PosesThatAreNotStoredAreRefusedEverywhere) {
    put_dataset(file_, "/time", H5::PredType::IEEE_F64LE, {1'000'000'000}, in_chunks({1000}));
    expect_rejection("/time declares values that are not stored");
}

}  // namespace
}  // namespace samara
