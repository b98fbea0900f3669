#include "samara/motion/file_check.hpp"

#include <random>
#include <string>
#include <vector>

#include <H5Cpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "c_interface_calls.hpp"
#include "paths.hpp"
#include "samara/core/base/error.hpp"
#include "samara/core/body/body_file.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/replace_file.hpp"
#include "samara/motion/motion_file.hpp"
#include "support/expect_error.hpp"
#include "support/program_run.hpp"
#include "support/test_shapes.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::error_of;
using test::ProgramRun;
using testing::AllOf;
using testing::HasSubstr;

class FileCheck : public testing::Test {
  protected:
    void SetUp() override {
        write_body_file(body_, test::full_body());
        write_motion_file(motion_, test::motion_of([](double t) { return test::tumble(t, 1.0, 1.0); }, 1.0));
    }

    test::TemporaryFolder folder_;
    std::filesystem::path body_ = folder_ / "a.body.h5";
    std::filesystem::path motion_ = folder_ / "m.h5";
};

TEST_F(FileCheck, TellsKindAndDigest) {
    EXPECT_EQ(check_file(body_).kind, "body");
    EXPECT_EQ(check_file(motion_).kind, "motion");
    EXPECT_TRUE(check_file(motion_).has_digest);
    const std::string bytes = read_bytes(body_);
    replace_file_with(body_, bytes.substr(0, bytes.size() - 48));
    EXPECT_FALSE(check_file(body_).has_digest);
}

TEST_F(FileCheck, PassesOnWhatTheReaderSays) {
    Body body = test::full_body();
    body.moments.volume = -1.0;
    write_body_file(body_, body);
    EXPECT_THAT(error_of([&] { (void)check_file(body_); }),
                HasSubstr("a.body.h5: the volume is not positive"));
    EXPECT_THAT(error_of([&] { (void)check_file(folder_ / "none.h5"); }), HasSubstr("does not exist"));
}

void copy_attributes(const H5::H5Object& from, const H5::H5Object& to) {
    for (int i = 0; i < from.getNumAttrs(); ++i) {
        const H5::Attribute attribute = from.openAttribute(static_cast<unsigned>(i));
        std::vector<char> value(attribute.getStorageSize());
        attribute.read(attribute.getDataType(), value.data());
        to.createAttribute(attribute.getName(), attribute.getDataType(), attribute.getSpace())
            .write(attribute.getDataType(), value.data());
    }
}

void copy_content(const H5::Group& from, const H5::Group& to) {
    copy_attributes(from, to);
    for (hsize_t i = 0; i < from.getNumObjs(); ++i) {
        const std::string name = from.getObjnameByIdx(i);
        if (from.childObjType(name) == H5O_TYPE_GROUP) {
            copy_content(from.openGroup(name), to.createGroup(name));
            continue;
        }
        const H5::DataSet data = from.openDataSet(name);
        std::vector<char> values(data.getInMemDataSize());
        data.read(values.data(), data.getDataType());
        to.createDataSet(name, data.getDataType(), data.getSpace()).write(values.data(), data.getDataType());
    }
}

/// The file in HDF5's oldest format, whose structures have no checksums, so that damage reaches their reader.
std::string without_checksums(const std::filesystem::path& file) {
    const std::filesystem::path old = file.string() + ".old";
    {
        const H5::H5File from(file.string(), H5F_ACC_RDONLY);
        const H5::H5File to(old.string(), H5F_ACC_TRUNC);
        copy_content(from.openGroup("/"), to.openGroup("/"));
    }
    return read_bytes(old);
}

TEST_F(FileCheck, NoDamageToStructuresHarmsWhoAsks) {
    for (const std::filesystem::path& file : {body_, motion_}) {
        const std::string sound = without_checksums(file);
        replace_file_with(file, sound);
        ASSERT_NO_THROW((void)check_file(file));
        std::mt19937 generator(3);
        int rejected = 0;
        for (int trial = 0; trial < 30; ++trial) {
            std::string damaged = sound;
            for (int i = 0; i < 10; ++i) damaged[96 + generator() % 6000] = static_cast<char>(generator());
            replace_file_with(file, damaged);
            try {
                (void)check_file(file);
            } catch (const Error& error) {
                EXPECT_THAT(error.what(), HasSubstr(file.filename().string()));
                EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
                ++rejected;
            }
        }
        EXPECT_GT(rejected, 10);
    }
}

TEST_F(FileCheck, TheCommandSaysWhatItFound) {
    const ProgramRun sound = run_program_in(folder_, {"samara", "check", "m.h5", "--json"});
    ASSERT_EQ(sound.status, 0) << sound.error;
    EXPECT_EQ(sound.json()["kind"], "motion");
    EXPECT_EQ(sound.json()["digest"], true);
    const std::string bytes = read_bytes(body_);
    (void)folder_.file("short.h5", bytes.substr(0, bytes.size() / 2));
    const ProgramRun damaged = run_program_in(folder_, {"samara", "check", "short.h5"});
    EXPECT_EQ(damaged.status, 1);
    EXPECT_TRUE(test::is_one_line(damaged.error));
    EXPECT_THAT(damaged.error, HasSubstr("short.h5"));
}

TEST_F(FileCheck, TheCommandAddsADigestAndNothingElse) {
    const std::string bytes = read_bytes(body_);
    replace_file_with(body_, bytes.substr(0, bytes.size() - 48));
    const ProgramRun info = run_program_in(folder_, {"samara", "info", "a.body.h5", "--json"});
    EXPECT_EQ(info.json()["digest"], false);
    EXPECT_THAT(run_program_in(folder_, {"samara", "check", "a.body.h5"}).output,
                HasSubstr("without a digest"));
    ASSERT_EQ(run_program_in(folder_, {"samara", "check", "a.body.h5", "--add-digest"}).status, 0);
    EXPECT_EQ(read_bytes(body_), bytes);
}

TEST_F(FileCheck, TheCInterfaceReadsUntrustedFilesLikeOthers) {
    samara_body* loaded = nullptr;
    test::Text error;
    ASSERT_EQ(CALL(samara_body_load_untrusted, body_.c_str(), &loaded), SAMARA_OK) << error.text();
    const test::BodyPointer body(loaded, samara_body_free);
    EXPECT_STREQ(samara_body_name(body.get()), "pebble");
    EXPECT_EQ(CALL(samara_body_load_untrusted, "/proc/none.h5", &loaded), SAMARA_UNREADABLE_FILE);
    EXPECT_EQ(loaded, nullptr);
    EXPECT_THAT(error.text(), HasSubstr("does not exist"));
}

TEST(ReadyBakedBodies, CarryADigest) {
    for (const auto& entry : std::filesystem::directory_iterator(
             std::filesystem::path(SAMARA_SOURCE_DIRECTORY) / "runtime/bodies")) {
        if (!is_body_file_name(entry.path())) continue;
        EXPECT_TRUE(check_file(entry.path()).has_digest) << entry.path();
    }
}

}  // namespace
}  // namespace samara
