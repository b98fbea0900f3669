#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "irregular_flutter.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/motion/motion_file.hpp"
#include "support/program_run.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::ProgramRun;
using test::TemporaryFolder;
using ::testing::HasSubstr;

class CompareCommand : public ::testing::Test {
  protected:
    CompareCommand() {
        Motion motion = test::irregular_flutter(1, 6.0);
        const Motion second = test::irregular_flutter(2, 6.0);
        motion.runs = 2;
        motion.bodies[0].poses.insert(motion.bodies[0].poses.end(), second.bodies[0].poses.begin(),
                                      second.bodies[0].poses.end());
        write_motion_file(folder_ / "motion.h5", motion);
        Motion reference = test::irregular_flutter(3, 5.0, 100.0);
        reference.bodies[0].name = "reference body";
        write_motion_file(folder_ / "reference.h5", reference);
    }
    [[nodiscard]] ProgramRun run(std::vector<std::string> words) const {
        words.insert(words.begin(), {"samara", "compare"});
        return run_program_in(folder_, words);
    }
    void expect_rejection(const std::vector<std::string>& words, const std::string& text) const {
        const ProgramRun done = run(words);
        EXPECT_EQ(done.status, 1);
        EXPECT_TRUE(test::is_one_line(done.error)) << done.error;
        EXPECT_THAT(done.error, HasSubstr(text));
        EXPECT_TRUE(done.output.empty()) << done.output;
    }

    TemporaryFolder folder_;
};

std::uint32_t big_endian(const std::string& bytes, std::size_t place) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8U | static_cast<unsigned char>(bytes.at(place + i));
    return value;
}

TEST_F(CompareCommand, ReportsMetricsWithErrorsAndVerdictsAsTextAndJson) {
    const ProgramRun text = run({"motion.h5", "reference.h5"});
    ASSERT_EQ(text.status, 0) << text.error;
    EXPECT_THAT(text.output, HasSubstr("1.67 s to 5 s of fall"));
    EXPECT_THAT(text.output, HasSubstr("fluttering, 2 of 2"));
    EXPECT_THAT(text.output, HasSubstr("the motion agrees with the reference"));

    const nlohmann::json json = run({"motion.h5", "reference.h5", "--json"}).json();
    EXPECT_EQ(json["agrees"], true);
    EXPECT_EQ(json["judged_by"], "metrics");
    EXPECT_EQ(json["agrees_by_metrics"], true);
    EXPECT_EQ(json["motion"]["file"], "motion.h5");
    EXPECT_EQ(json["motion"]["falls"], 2);
    EXPECT_EQ(json["reference"]["body"], "reference body");
    EXPECT_NEAR(json["window"][1].get<double>(), 5.0, 1e-9);
    for (const char* key : {"descent_speed", "frequency", "spectral_frequency", "inclination_amplitude",
                            "mean_inclination", "rms_angular_speed", "path_spread", "drift_speed"}) {
        const nlohmann::json& one = json["measures"][key];
        EXPECT_TRUE(one["motion"]["error"].is_number()) << key;
        EXPECT_TRUE(one["reference"]["error"].is_number()) << key;
        EXPECT_TRUE(one["difference_error"].is_number()) << key;
    }
    EXPECT_NEAR(json["measures"]["descent_speed"]["limit"].get<double>(),
                0.1 * json["measures"]["descent_speed"]["reference"]["value"].get<double>(), 1e-12);
    EXPECT_EQ(json["distributions"]["inclination"]["quantiles"].size(), 5U);
    EXPECT_GT(json["first_swing"]["way_fallen"].get<double>(), 0.0);
}

TEST_F(CompareCommand, TakesTheRunWindowAndTolerancesAskedFor) {
    const nlohmann::json json = run({"motion.h5", "reference.h5", "--run", "1", "--window", "1,4.5",
                                     "--descent-tolerance", "0.0001", "--json"})
                                    .json();
    EXPECT_EQ(json["motion"]["falls"], 1);
    EXPECT_EQ(json["window"], nlohmann::json({1.0, 4.5}));
    EXPECT_EQ(json["measures"]["descent_speed"]["agrees"], false);
    EXPECT_EQ(json["agrees"], false);
}

TEST_F(CompareCommand, DrawsAPngOfTheStatedSizeAndAnSvgWithItsText) {
    const ProgramRun png = run({"motion.h5", "reference.h5", "-o", "picture.png", "--json"});
    ASSERT_EQ(png.status, 0) << png.error;
    EXPECT_EQ(png.json()["output"], "picture.png");
    const std::string bytes = read_bytes(folder_ / "picture.png");
    ASSERT_GT(bytes.size(), 50000U);
    EXPECT_EQ(big_endian(bytes, 16), 2000U);
    EXPECT_EQ(big_endian(bytes, 20), 1300U);
    ASSERT_EQ(run({"motion.h5", "reference.h5", "-o", "picture.svg"}).status, 0);
    const std::string svg = read_bytes(folder_ / "picture.svg");
    for (const char* text : {"</svg>", "agrees with the reference", "Inclination", "Spectrum",
                             "motion.h5 (2 falls)", "reference.h5", "Time below"}) {
        EXPECT_THAT(svg, HasSubstr(text));
    }
}

TEST_F(CompareCommand, DrawsFallsThatDoNotSwingOrMove) {
    write_motion_file(folder_ / "rest.h5", test::motion_of([](double) { return Pose{}; }, 2.0));
    const ProgramRun done = run({"rest.h5", "rest.h5", "-o", "rest.png"});
    EXPECT_EQ(done.status, 0) << done.error;
    EXPECT_GT(read_bytes(folder_ / "rest.png").size(), 20000U);
    EXPECT_THAT(done.output, ::testing::ContainsRegex("frequency \\(Hz\\) +- +-\n"));
    EXPECT_THAT(done.output, HasSubstr("the motion agrees with the reference"));
}

TEST_F(CompareCommand, RefusesWhatItCannotCompareInOneLine) {
    expect_rejection({"motion.h5", "none.h5"}, "none.h5: does not exist; check the name");
    std::ignore = folder_.file("text.h5", "no motion");
    expect_rejection({"motion.h5", "text.h5"}, "text.h5: is not an HDF5 file");
    expect_rejection({"motion.h5", "reference.h5", "--window", "1to4"}, "--window takes BEGIN,END");
    expect_rejection({"motion.h5", "reference.h5", "--window", "1,6"}, "is not within both falls");
    expect_rejection({"motion.h5", "reference.h5", "--run", "2"}, "not run 2");
    expect_rejection({"motion.h5", "reference.h5", "--reference-copy", "1"}, "not copy 1");
    expect_rejection({"motion.h5", "reference.h5", "-o", "picture.pdf"}, "end the name in .png or .svg");
    expect_rejection({"motion.h5", "reference.h5", "--body", "leaf"}, "motion.h5: holds no body 'leaf'");
}

TEST_F(CompareCommand, MatchesBodiesByName) {
    Motion two = test::irregular_flutter(4, 5.0);
    two.bodies.push_back(test::irregular_flutter(5, 5.0).bodies[0]);
    two.bodies[1].name = "plate";
    write_motion_file(folder_ / "two.h5", two);
    EXPECT_EQ(run({"motion.h5", "two.h5", "--json"}).json()["reference"]["body"], "ellipsoid");
    expect_rejection({"two.h5", "two.h5"},
                     "hold several bodies of the same name (ellipsoid, plate); choose one");
    EXPECT_EQ(run({"two.h5", "two.h5", "--body", "plate", "--json"}).json()["motion"]["body"], "plate");
    expect_rejection({"two.h5", "reference.h5"},
                     "hold no body of the same name: ellipsoid, plate against reference body");
}

}  // namespace
}  // namespace samara
