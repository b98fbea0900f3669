#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "samara/core/files/content_hash.hpp"
#include "samara/export/csv_file.hpp"
#include "samara/export/gltf_file.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/motion/resample.hpp"
#include "samara/motion/selection.hpp"
#include "support/program_run.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::ProgramRun;
using test::TemporaryFolder;
using ::testing::HasSubstr;

/// Six leaves, a seed and a roof, for a second.
Motion leaves_seed_and_roof() {
    Motion motion = test::motion_of(test::wander, 1.0);
    motion.bodies.push_back(motion.bodies[0]);
    motion.bodies[0].name = "leaf";
    motion.bodies[1].name = "seed";
    test::let_wander(motion.bodies[0], 6, motion.times);
    const Surface sheet{
        .vertices = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, .corners = {{0, 1, 2}}, .edge_nodes = {}};
    motion.obstacles = {{.name = "roof", .surface = sheet, .keys = {{}}}};
    return motion;
}

class ExportOptions : public ::testing::Test {
  protected:
    ExportOptions() { write_motion_file(folder_ / "motion.h5", motion_); }
    [[nodiscard]] ProgramRun run(std::vector<std::string> words) const {
        words.insert(words.begin(), {"samara", "export", "motion.h5", "-o"});
        return run_program_in(folder_, words);
    }
    void expect_rejection(const std::vector<std::string>& words, const std::string& text) const {
        const ProgramRun done = run(words);
        EXPECT_EQ(done.status, 1);
        EXPECT_TRUE(test::is_one_line(done.error)) << done.error;
        EXPECT_THAT(done.error, HasSubstr(text));
        EXPECT_FALSE(std::filesystem::exists(folder_ / words.front()));
    }

    TemporaryFolder folder_;
    Motion motion_ = leaves_seed_and_roof();
};

TEST_F(ExportOptions, WritesTheNamedBodiesAndCopiesUnderTheirOwnNumbers) {
    const ProgramRun done = run({"part.csv", "--body", "leaf", "--copy", "2-4", "--json"});
    ASSERT_EQ(done.status, 0) << done.error;
    EXPECT_EQ(done.json()["rows"], 3 * 61);
    write_csv(folder_ / "expected.csv", selected(motion_, {"leaf"}, CopyRange{2, 4}), std::nullopt, {}, 2);
    EXPECT_EQ(read_bytes(folder_ / "part.csv"), read_bytes(folder_ / "expected.csv"));
    EXPECT_THAT(read_bytes(folder_ / "part.csv"), HasSubstr("\n0,leaf,2,0,"));

    ASSERT_EQ(run({"part.chan", "--body", "leaf", "--copy", "5"}).status, 0);
    ASSERT_EQ(run({"all.chan", "--body", "seed,leaf"}).status, 0);
    EXPECT_EQ(read_bytes(folder_ / "part.chan"), read_bytes(folder_ / "all_leaf.005.chan"));
    ASSERT_EQ(run({"part.usda", "--body", "leaf", "--copy", "1-2"}).status, 0);
    EXPECT_THAT(read_bytes(folder_ / "part.usda"), HasSubstr("def Xform \"leaf_002\""));
    EXPECT_THAT(read_bytes(folder_ / "part.usda"), testing::Not(HasSubstr("roof")));
}

TEST_F(ExportOptions, NamesTheNearestBodyAndTheCopiesThereAre) {
    expect_rejection({"part.glb", "--body", "laef"}, "holds no body or obstacle 'laef'");
    expect_rejection({"part.glb", "--body", "laef"}, "did you mean 'leaf'?");
    expect_rejection({"part.glb", "--body", "roof"}, "names obstacles alone");
    expect_rejection({"part.glb", "--body", "leaf", "--copy", "6"},
                     "holds copies 0 to 5 of leaf, not copy 6; give one of these");
    expect_rejection({"part.glb", "--copy", "1"}, "holds only copy 0 of seed, not copy 1");
    for (const char* words : {"4-2", "-1", "1-", "two", "1,2"}) {
        expect_rejection({"part.glb", std::string("--copy=") + words}, "is no copy and no range of copies");
    }
}

TEST_F(ExportOptions, SlowsTheMotionAtTheFrameRateAskedFor) {
    const ProgramRun done = run({"slow.csv", "--slow", "10", "--frame-rate", "24", "--json"});
    ASSERT_EQ(done.status, 0) << done.error;
    EXPECT_EQ(done.json()["frame_rate"], 24.0);
    EXPECT_EQ(done.json()["frames"], 241);
    write_csv(folder_ / "expected.csv", resampled(slowed(motion_, 10.0), 24.0));
    EXPECT_EQ(read_bytes(folder_ / "slow.csv"), read_bytes(folder_ / "expected.csv"));
    EXPECT_EQ(run({"slow.glb", "--slow", "10", "--json"}).json()["frame_rate"], 60.0);
}

TEST_F(ExportOptions, WritesOneFrameAsInstances) {
    const ProgramRun done = run({"still.glb", "--at", "0.51", "--instances", "--json"});
    ASSERT_EQ(done.status, 0) << done.error;
    EXPECT_EQ(done.json()["frames"], 1);
    EXPECT_EQ(done.json()["instances"], 7);
    write_glb(folder_ / "expected.glb", still_at(motion_, 0.51), 0, std::nullopt, {}, true);
    EXPECT_EQ(read_bytes(folder_ / "still.glb"), read_bytes(folder_ / "expected.glb"));
    expect_rejection({"part.glb", "--at", "1.5"}, "the motion lasts from 0 to 1 s");
    expect_rejection({"part.glb", "--instances"}, "add --at SECONDS");
    expect_rejection({"part.glb", "--at", "0.5", "--loop", "0.5"}, "leave one of them out");
}

TEST_F(ExportOptions, TakesColorsWithAndWithoutTheirSign) {
    ASSERT_EQ(run({"one.usda", "--colors", "ff0000,#0000FF"}).status, 0);
    EXPECT_THAT(read_bytes(folder_ / "one.usda"), HasSubstr("primvars:displayColor = [(0, 0, 1)]"));
    for (const char* words : {"red", "#ff00", "12345g", ","}) {
        expect_rejection({"part.usda", "--colors", words}, "--colors");
    }
}

TEST_F(ExportOptions, RejectsOptionsThatTheFormatLeavesWithoutEffect) {
    expect_rejection({"part.csv", "--colors", "ff0000"}, "--colors applies to .glb and .usda and .html only");
    expect_rejection({"part.usda", "--at", "0", "--instances"}, "--instances applies to .glb only");
    expect_rejection({"part.glb", "--chan", "houdini"}, "--chan applies to .chan only");
    expect_rejection({"part.html", "--tolerance", "0"}, "--tolerance applies to .glb and .usda only");
}

}  // namespace
}  // namespace samara
