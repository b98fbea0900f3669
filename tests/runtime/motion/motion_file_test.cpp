#include "samara/motion/motion_file.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/core/files/hdf5_reader.hpp"
#include "samara/core/files/hdf5_writer.hpp"
#include "samara/core/files/replace_file.hpp"
#include "samara/motion/motion_writer.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::TemporaryFolder;
using ::testing::HasSubstr;

Motion two_bodies() {
    const auto early = [](double t) { return test::flutter(t, 1.0, 0.5, 0.2); };
    const auto late = [](double t) { return test::tumble(t + 10.0, 5.0, 0.3); };
    Motion motion = test::motion_of(early, 0.5, 20.0);
    Motion other = test::motion_of(late, 0.5, 20.0);
    motion.runs = 2;
    motion.seed = 0xfedcba9876543210;
    motion.gravity = Vector3d(0.0, -1.0, -9.0);
    BodyMotion& first = motion.bodies[0];
    first.name = "z first";
    first.center_of_mass = Vector3d(0.001, -0.002, 0.003);
    first.poses.insert(first.poses.end(), other.bodies[0].poses.begin(), other.bodies[0].poses.end());
    BodyMotion second = other.bodies[0];
    second.name = "a second, with two copies";
    second.uncertainties = {{"closure", "descent_speed", 0.05, 0.01}, {"mesh", "descent_speed", 0.03}};
    second.copies = 2;
    second.poses.clear();
    for (int i = 0; i < 2 * 2 * motion.frames(); ++i) second.poses.push_back(late(0.01 * i));
    motion.bodies.push_back(second);
    return motion;
}

std::string error_of(const auto& action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    return "no error";
}

std::string reading_error(const std::filesystem::path& file) {
    return error_of([&] { (void)read_motion_file(file); });
}

TEST(MotionFile, KeepsTheFluidsForcesWhereTheyWereAskedFor) {
    const TemporaryFolder folder;
    Motion motion = two_bodies();
    EXPECT_FALSE(motion.has_forces);
    motion.has_forces = true;
    double value = 0.0;
    for (BodyMotion& body : motion.bodies) {
        body.forces.resize(body.poses.size());
        for (FluidForces& forces : body.forces) {
            for (const auto& [name, part] : parts_of_fluid_forces) {
                forces.*part = {Vector3d(value, value + 0.1, value + 0.2), Vector3d(0.3, value, -value)};
                value += 1.0;
            }
        }
    }
    write_motion_file(folder / "motion.h5", motion);
    const Motion read = read_motion_file(folder / "motion.h5");
    ASSERT_TRUE(read.has_forces);
    for (std::size_t i = 0; i < 2; ++i) {
        ASSERT_EQ(read.bodies[i].forces.size(), motion.bodies[i].forces.size());
        for (std::size_t k = 0; k < read.bodies[i].forces.size(); ++k) {
            for (const auto& [name, part] : parts_of_fluid_forces) {
                EXPECT_EQ(read.bodies[i].forces[k].*part, motion.bodies[i].forces[k].*part);
            }
        }
    }
    EXPECT_TRUE(Hdf5Reader(folder / "motion.h5").has("/bodies/z first/forces/drag"));
}

TEST(MotionFile, RefusesUncertaintiesThatAreNone) {
    const TemporaryFolder folder;
    const auto error_with = [&](const std::vector<MetricUncertainty>& uncertainties) {
        Motion motion = two_bodies();
        motion.bodies[0].uncertainties = uncertainties;
        return error_of([&] { write_motion_file(folder / "motion.h5", motion); });
    };
    EXPECT_EQ(error_with({{"mesh", "descent_speed", 0.0}}), "no error");
    EXPECT_THAT(error_with({{"mesh", "descent_speed", -0.1}}), HasSubstr("uncertainty that is negative"));
    EXPECT_THAT(error_with({{"mesh", "descent_speed", 0.1, -0.1}}),
                HasSubstr("uncertainty that is negative"));
    EXPECT_THAT(error_with({{"", "descent_speed", 0.1}}), HasSubstr("duplicate or unnamed uncertainty"));
    EXPECT_THAT(error_with({{"mesh", "a/b", 0.1}}), HasSubstr("duplicate or unnamed uncertainty"));
    EXPECT_THAT(error_with({{"mesh", "descent_speed", 0.1}, {"mesh", "descent_speed", 0.1}}),
                HasSubstr("duplicate or unnamed uncertainty"));
}

TEST(MotionFile, GivesBackWhatWasWritten) {
    const TemporaryFolder folder;
    const Motion written = two_bodies();
    write_motion_file(folder / "motion.h5", written);
    const Motion read = read_motion_file(folder / "motion.h5");
    EXPECT_EQ(read.times, written.times);
    EXPECT_EQ(read.runs, 2);
    EXPECT_EQ(read.frame_rate, 20.0);
    EXPECT_EQ(read.seed, written.seed);
    EXPECT_EQ(read.gravity, written.gravity);
    EXPECT_EQ(read.scene_text, written.scene_text);
    ASSERT_EQ(read.bodies.size(), 2U);
    for (std::size_t b = 0; b < 2; ++b) {
        const BodyMotion& is = read.bodies[b];
        const BodyMotion& was = written.bodies[b];
        EXPECT_EQ(is.name, was.name);
        EXPECT_EQ(is.copies, was.copies);
        EXPECT_EQ(is.center_of_mass, was.center_of_mass);
        EXPECT_EQ(is.shortest_axis, was.shortest_axis);
        EXPECT_EQ(is.body_hash, was.body_hash);
        EXPECT_EQ(is.models, was.models);
        EXPECT_EQ(is.uncertainties, was.uncertainties);
        EXPECT_EQ(is.surface.vertices, was.surface.vertices);
        EXPECT_EQ(is.surface.corners, was.surface.corners);
        ASSERT_EQ(is.poses.size(), was.poses.size());
        for (std::size_t i = 0; i < is.poses.size(); ++i) {
            EXPECT_EQ(is.poses[i].position, was.poses[i].position);
            EXPECT_EQ(is.poses[i].orientation.coeffs(), was.poses[i].orientation.coeffs());
            EXPECT_EQ(is.poses[i].velocity, was.poses[i].velocity);
            EXPECT_EQ(is.poses[i].angular_velocity, was.poses[i].angular_velocity);
        }
    }
}

TEST(MotionFile, HasTheDocumentedLayout) {
    const TemporaryFolder folder;
    const Motion motion = two_bodies();
    write_motion_file(folder / "motion.h5", motion);
    const Hdf5Reader file(folder / "motion.h5");
    const std::string group = "/bodies/a second, with two copies";
    const auto n = static_cast<hsize_t>(motion.frames());
    EXPECT_EQ(file.shape("/time"), (std::vector<hsize_t>{n}));
    EXPECT_EQ(file.shape(group + "/position"), (std::vector<hsize_t>{2, n, 2, 3}));
    EXPECT_EQ(file.shape(group + "/orientation"), (std::vector<hsize_t>{2, n, 2, 4}));
    EXPECT_EQ(file.shape(group + "/velocity"), (std::vector<hsize_t>{2, n, 2, 3}));
    EXPECT_EQ(file.shape(group + "/angular_velocity"), (std::vector<hsize_t>{2, n, 2, 3}));
    EXPECT_EQ(file.text("/scene"), motion.scene_text);
    EXPECT_EQ(file.integer_attribute("/", "format_version"), 1);
    EXPECT_EQ(file.text_attribute("/", "kind"), "motion");
    // Run 1, frame 2, copy 1: w comes first.
    const Quaterniond q = motion.pose(motion.bodies[1], 1, 2, 1).orientation;
    const std::vector<double> values = file.finite_doubles(group + "/orientation", {2, n, 2, 4});
    const std::size_t place = 4 * ((1 * n + 2) * 2 + 1);
    EXPECT_EQ(values[place], q.w());
    EXPECT_EQ(values[place + 2], q.y());
}

TEST(MotionFile, EqualMotionsGiveEqualBytes) {
    const TemporaryFolder folder;
    write_motion_file(folder / "one.h5", two_bodies());
    write_motion_file(folder / "other.h5", two_bodies());
    EXPECT_EQ(read_bytes(folder / "one.h5"), read_bytes(folder / "other.h5"));
}

TEST(MotionFile, HoldsManyPosesInBoundedChunks) {
    const TemporaryFolder folder;
    Motion motion = test::motion_of([](double t) { return test::tumble(t, 1.0, 1.0); }, 0.0);
    BodyMotion& body = motion.bodies[0];
    body.copies = 100000;
    body.poses.assign(100000, body.poses[0]);
    body.poses.back().position.z() = 7.0;
    write_motion_file(folder / "motion.h5", motion);
    EXPECT_EQ(read_motion_file(folder / "motion.h5").bodies[0].poses.back().position.z(), 7.0);
}

TEST(MotionFile, WrittenBlockByBlockHasTheBytesOfOneWrittenWhole) {
    const TemporaryFolder folder;
    // More frames than a block holds.
    const Motion motion = test::motion_of([](double t) { return test::tumble(t, 1.0, 1.0); }, 10.0, 1000.0);
    write_motion_file(folder / "whole.h5", motion);
    Motion empty = motion;
    empty.bodies[0].poses.clear();
    const std::size_t block = frames_in_block(motion);
    ASSERT_LT(block, motion.times.size());
    write_motion_file(folder / "blocks.h5", empty, [&](MotionWriter& writer) {
        const auto& poses = motion.bodies[0].poses;
        for (std::size_t first = 0; first < poses.size(); first += block) {
            const std::size_t end = std::min(first + block, poses.size());
            writer.write({0, first, {0, 1}, {poses.data() + first, poses.data() + end}, {}});
        }
        writer.finish(poses.size(), {1});
    });
    EXPECT_EQ(read_bytes(folder / "whole.h5"), read_bytes(folder / "blocks.h5"));
    const Motion read = read_motion_file(folder / "blocks.h5");
    EXPECT_EQ(read.bodies[0].poses[5000].position, motion.bodies[0].poses[5000].position);
}

TEST(MotionFile, IsReadInPartsThatMakeUpTheWhole) {
    const TemporaryFolder folder;
    const Motion motion = two_bodies();
    write_motion_file(folder / "motion.h5", motion);
    const MotionReader reader(folder / "motion.h5");
    ASSERT_EQ(reader.motion().bodies.size(), 2U);
    for (std::size_t i = 0; i < 2; ++i) {
        const BodyMotion& body = motion.bodies[i];
        const PoseBlock last{motion.runs - 1, 1, body.copies - 1, 1};
        const std::vector<Pose> poses = reader.poses(i, last);
        ASSERT_EQ(poses.size(), motion.times.size());
        for (int frame = 0; frame < motion.frames(); ++frame) {
            EXPECT_EQ(poses[static_cast<std::size_t>(frame)].position,
                      motion.pose(body, last.first_run, frame, last.first_copy).position);
        }
    }
}

TEST(MotionFile, ThatTheDiskHasNoRoomForIsRefusedAndLeavesNothing) {
    const TemporaryFolder folder;
    Motion motion = test::motion_of([](double t) { return test::tumble(t, 1.0, 1.0); }, 1.0);
    motion.runs = 2'000'000;
    motion.bodies[0].copies = 1'000'000;
    bool filled = false;
    const std::string error = error_of(
        [&] { write_motion_file(folder / "motion.h5", motion, [&](MotionWriter&) { filled = true; }); });
    EXPECT_THAT(error, AllOf(HasSubstr("motion.h5"), HasSubstr("no space")));
    EXPECT_FALSE(filled);
    EXPECT_EQ(folder.file_count(), 0);
}

TEST(MotionFile, RefusesFilesOfOtherKinds) {
    const TemporaryFolder folder;
    EXPECT_THAT(reading_error(folder / "none.h5"), HasSubstr("does not exist"));
    replace_file_with(folder / "text.h5", "not HDF5");
    EXPECT_THAT(reading_error(folder / "text.h5"), HasSubstr("not an HDF5 file"));
    write_hdf5(folder / "other.h5", [](Hdf5Writer& file) { file.attribute("/moments", "volume", 1.0); });
    EXPECT_THAT(reading_error(folder / "other.h5"), HasSubstr("not a motion file"));
    EXPECT_FALSE(is_motion_file(folder / "none.h5"));
    EXPECT_FALSE(is_motion_file(folder / "text.h5"));
    EXPECT_FALSE(is_motion_file(folder / "other.h5"));
    write_motion_file(folder / "motion.h5", two_bodies());
    EXPECT_TRUE(is_motion_file(folder / "motion.h5"));
}

TEST(MotionFile, RefusesACutOrDamagedFile) {
    const TemporaryFolder folder;
    write_motion_file(folder / "motion.h5", two_bodies());
    const std::string bytes = read_bytes(folder / "motion.h5");
    replace_file_with(folder / "cut.h5", std::string_view(bytes).substr(0, bytes.size() / 2));
    EXPECT_THAT(reading_error(folder / "cut.h5"), HasSubstr("cut.h5"));
    std::string damaged = bytes;
    const double marker = two_bodies().bodies[0].poses[5].position.z();
    const auto place = damaged.find(std::string(reinterpret_cast<const char*>(&marker), sizeof marker));
    ASSERT_NE(place, std::string::npos);
    damaged[place] = static_cast<char>(damaged[place] ^ 1);
    replace_file_with(folder / "damaged.h5", damaged);
    EXPECT_THAT(reading_error(folder / "damaged.h5"), HasSubstr("damaged"));
}

/// A file that another program wrote: a body of one run, two frames and one copy, but for what `change`
/// alters.
struct ForeignFile {
    std::vector<double> times = {0.0, 0.1};
    std::vector<double> positions = std::vector<double>(6, 0.0);
    std::vector<double> orientations = {1, 0, 0, 0, 1, 0, 0, 0};
    std::vector<hsize_t> shape = {1, 2, 1, 3};
    std::int64_t version = 1;
};

std::string error_of_foreign(const ForeignFile& content, const std::filesystem::path& path) {
    write_hdf5(path, [&](Hdf5Writer& file) {
        file.attribute("/", "format_version", content.version);
        file.attribute("/", "frame_rate", 10.0);
        file.attribute("/", "seed", std::uint64_t{1});
        file.write("/time", content.times, {content.times.size()}, "s", "");
        file.write("/gravity", std::vector{0.0, 0.0, -9.81}, {3}, "m/s^2", "");
        file.write_text("/scene", "", "");
        file.write("/bodies/b/position", content.positions, content.shape, "m", "");
        file.write("/bodies/b/orientation", content.orientations, {1, 2, 1, 4}, "1", "");
        file.write("/bodies/b/velocity", std::vector<double>(6, 0.0), {1, 2, 1, 3}, "m/s", "");
        file.write("/bodies/b/angular_velocity", std::vector<double>(6, 0.0), {1, 2, 1, 3}, "rad/s", "");
        file.write("/bodies/b/center_of_mass", std::vector{0.0, 0.0, 0.0}, {3}, "m", "");
        file.write("/bodies/b/shortest_axis", std::vector{0.0, 0.0, 1.0}, {3}, "1", "");
        file.write("/bodies/b/surface/vertices", std::vector<double>(9, 0.0), {3, 3}, "m", "");
        file.write("/bodies/b/surface/corners", std::vector<std::int32_t>{0, 1, 2}, {1, 3}, "1", "");
        file.attribute("/bodies/b", "index", std::int64_t{0});
        file.attribute("/bodies/b", "body_hash", std::string_view("none"));
        file.attribute("/bodies/b", "models", std::string_view("none"));
    });
    return reading_error(path);
}

TEST(MotionFile, ReadsFilesOfOtherProgramsAndRefusesTheirErrors) {
    const TemporaryFolder folder;
    const auto error = [&](const auto& change) {
        ForeignFile content;
        change(content);
        return error_of_foreign(content, folder / "foreign.h5");
    };
    EXPECT_EQ(error([](ForeignFile&) {}), "no error");
    EXPECT_THAT(error([](ForeignFile& f) { f.times = {0.0, 0.0}; }), HasSubstr("does not ascend at row 1"));
    EXPECT_THAT(error([](ForeignFile& f) {
                    f.times = {0.0, 0.1, 0.2};
                }),
                AllOf(HasSubstr("/bodies/b/position"), HasSubstr("3 frames")));
    EXPECT_THAT(error([](ForeignFile& f) { f.positions[4] = std::numeric_limits<double>::quiet_NaN(); }),
                AllOf(HasSubstr("/bodies/b/position"), HasSubstr("not finite")));
    EXPECT_THAT(error([](ForeignFile& f) { f.orientations[4] = 1.1; }), HasSubstr("unit length"));
    EXPECT_THAT(error([](ForeignFile& f) { f.shape = {1, 1, 2, 3}; }), HasSubstr("shape"));
    EXPECT_THAT(error([](ForeignFile& f) { f.version = 2; }), HasSubstr("newer version"));
}

TEST(MotionFile, IsNotWrittenFromAMotionThatBreaksItsRules) {
    const TemporaryFolder folder;
    const auto error = [&](const auto& change) {
        Motion motion = two_bodies();
        change(motion);
        return error_of([&] { write_motion_file(folder / "motion.h5", motion); });
    };
    EXPECT_THAT(error([](Motion& m) { m.bodies[0].poses.pop_back(); }), HasSubstr("one pose for each"));
    EXPECT_THAT(error([](Motion& m) { m.bodies[0].name = m.bodies[1].name; }), HasSubstr("two bodies"));
    EXPECT_THAT(error([](Motion& m) { m.bodies[0].name = "a/b"; }), HasSubstr("slash"));
    EXPECT_THAT(error([](Motion& m) { m.bodies[0].surface.corners.clear(); }), HasSubstr("triangles"));
    EXPECT_THAT(error([](Motion& m) { m.times.clear(); }), HasSubstr("no frame"));
    EXPECT_FALSE(std::filesystem::exists(folder / "motion.h5"));
}

}  // namespace
}  // namespace samara
