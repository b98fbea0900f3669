#include <iterator>
#include <sstream>

#include <gtest/gtest.h>

#include "samara/core/base/error.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/export/chan_file.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::TemporaryFolder;

using Line = std::array<double, 7>;

std::vector<Line> lines_of(const std::filesystem::path& file) {
    std::istringstream stream(read_bytes(file));
    std::vector<Line> lines;
    for (std::string text; std::getline(stream, text);) {
        std::istringstream words(text);
        Line line{};
        for (double& value : line) words >> value;
        EXPECT_TRUE(words) << text;
        lines.push_back(line);
    }
    return lines;
}

/// The turn of a line: first about z, then about x, then about y, as Nuke's order ZXY says.
Quaterniond turn_of(const Line& line) {
    return Eigen::AngleAxisd(line[5] * test::degree, Vector3d::UnitY()) *
           Eigen::AngleAxisd(line[4] * test::degree, Vector3d::UnitX()) *
           Eigen::AngleAxisd(line[6] * test::degree, Vector3d::UnitZ());
}

/// The world with y up, whose z axis looks along the motion's -y.
const Quaterniond y_up(Eigen::AngleAxisd(-std::numbers::pi / 2.0, Vector3d::UnitX()));

void expect_reads_back(const std::filesystem::path& file, const Motion& motion, const BodyMotion& body,
                       int run, int copy) {
    const std::vector<Line> lines = lines_of(file);
    ASSERT_EQ(lines.size(), motion.times.size());
    for (std::size_t frame = 0; frame < lines.size(); ++frame) {
        const Line& line = lines[frame];
        const Pose& pose = motion.pose(body, run, static_cast<int>(frame), copy);
        EXPECT_EQ(line[0], static_cast<double>(frame));
        const Vector3d place = y_up * shape_origin(pose, body.center_of_mass);
        EXPECT_LT((Vector3d(line[1], line[2], line[3]) - place).norm(), 1e-14);
        EXPECT_LT(turn_of(line).angularDistance(y_up * pose.orientation * y_up.conjugate()), 1e-9);
    }
}

double largest_jump(const std::vector<Line>& lines) {
    double jump = 0.0;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        for (const std::size_t angle : {4U, 5U, 6U}) {
            jump = std::max(jump, std::abs(lines[i][angle] - lines[i - 1][angle]));
        }
    }
    return jump;
}

TEST(ChanExport, ReadsBackToThePose) {
    const TemporaryFolder folder;
    Motion motion = test::motion_of(test::wander, 3.0, 240.0);
    motion.bodies[0].center_of_mass = Vector3d(0.01, 0.02, -0.03);
    const auto files = write_chan(folder / "motion.chan", motion);
    ASSERT_EQ(files, std::vector<std::filesystem::path>{folder / "motion.chan"});
    expect_reads_back(files[0], motion, motion.bodies[0], 0, 0);
}

/// The columns of Houdini's layout, read as its default order XYZ says: first about x, then y, then z.
Quaterniond houdini_turn_of(const std::vector<double>& row) {
    return Eigen::AngleAxisd(row[5] * test::degree, Vector3d::UnitZ()) *
           Eigen::AngleAxisd(row[4] * test::degree, Vector3d::UnitY()) *
           Eigen::AngleAxisd(row[3] * test::degree, Vector3d::UnitX());
}

TEST(ChanExport, HoudinisLayoutHasNoFrameAndTurnsInItsOwnOrder) {
    const TemporaryFolder folder;
    Motion motion = test::motion_of(test::wander, 3.0, 240.0);
    motion.bodies[0].center_of_mass = Vector3d(0.01, 0.02, -0.03);
    write_chan(folder / "motion.chan", motion, 0, {}, ChanLayout::houdini);
    std::istringstream stream(read_bytes(folder / "motion.chan"));
    std::vector<double> before;
    std::size_t frame = 0;
    for (std::string line; std::getline(stream, line); ++frame) {
        std::istringstream words(line);
        const std::vector<double> row((std::istream_iterator<double>(words)), {});
        ASSERT_EQ(row.size(), 6U);
        ASSERT_LT(frame, motion.times.size());
        const Pose& pose = motion.bodies[0].poses[frame];
        const Vector3d place = y_up * shape_origin(pose, motion.bodies[0].center_of_mass);
        EXPECT_LT((Vector3d(row.data()) - place).norm(), 1e-14);
        EXPECT_LT(houdini_turn_of(row).angularDistance(y_up * pose.orientation * y_up.conjugate()), 1e-9);
        for (std::size_t i = 3; i < 6 && !before.empty(); ++i) EXPECT_LT(std::abs(row[i] - before[i]), 30.0);
        before = row;
    }
    EXPECT_EQ(frame, motion.times.size());
}

TEST(ChanExport, AnglesGoOnOverWholeTurnsAndThroughTheRightAngle) {
    const TemporaryFolder folder;
    for (const Vector3d& axis :
         {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1), Vector3d(1, 0.3, 0.2)}) {
        const Motion motion = test::motion_of(
            [&](double t) {
                Pose pose;
                pose.orientation = Eigen::AngleAxisd(9.0 * t, axis.normalized());
                return pose;
            },
            3.0, 240.0);
        write_chan(folder / "motion.chan", motion);
        expect_reads_back(folder / "motion.chan", motion, motion.bodies[0], 0, 0);
        EXPECT_LT(largest_jump(lines_of(folder / "motion.chan")), 30.0) << axis.transpose();
    }
}

TEST(ChanExport, HoldsThePoseAtAndNearTheRightAngle) {
    const TemporaryFolder folder;
    for (const double off : {0.0, 1e-12, 1e-9, 1e-8, 1e-5}) {
        const Motion motion = test::motion_of(
            [&](double t) {
                Pose pose;
                pose.orientation = y_up.conjugate() * Eigen::AngleAxisd(0.7 * t, Vector3d::UnitY()) *
                                   Eigen::AngleAxisd(std::numbers::pi / 2.0 - off, Vector3d::UnitX()) *
                                   Eigen::AngleAxisd(0.4, Vector3d::UnitZ()) * y_up;
                return pose;
            },
            1.0);
        write_chan(folder / "motion.chan", motion);
        expect_reads_back(folder / "motion.chan", motion, motion.bodies[0], 0, 0);
        EXPECT_LT(largest_jump(lines_of(folder / "motion.chan")), 60.0);
    }
}

TEST(ChanExport, ABodyInItsShapesAttitudeHasNoAngles) {
    const TemporaryFolder folder;
    write_chan(folder / "motion.chan", test::motion_of([](double) { return Pose{}; }, 0.0));
    EXPECT_EQ(lines_of(folder / "motion.chan"), std::vector<Line>{Line{}});
}

TEST(ChanExport, EachCopyHasAFileOfItsOwn) {
    const TemporaryFolder folder;
    Motion motion = test::motion_of(test::wander, 0.2);
    motion.runs = 2;
    BodyMotion& body = motion.bodies[0];
    body.name = "leaf/red";
    body.copies = 2;
    body.poses.clear();
    for (int i = 0; i < 2 * 2 * motion.frames(); ++i) body.poses.push_back(test::wander(0.1 * i));
    const auto files = write_chan(folder / "motion.chan", motion, 1);
    ASSERT_EQ(files.size(), 2U);
    EXPECT_EQ(files[0], folder / "motion_leaf_red.chan");
    EXPECT_EQ(files[1], folder / "motion_leaf_red.001.chan");
    expect_reads_back(files[0], motion, body, 1, 0);
    expect_reads_back(files[1], motion, body, 1, 1);
    EXPECT_EQ(folder.file_count(), 2);
}

TEST(ChanExport, RefusesFramesBetweenWholeOnes) {
    const TemporaryFolder folder;
    Motion motion = test::motion_of(test::wander, 0.2);
    for (double& time : motion.times) time += 0.004;
    EXPECT_THROW(write_chan(folder / "motion.chan", motion), Error);
    EXPECT_EQ(folder.file_count(), 0);
}

}  // namespace
}  // namespace samara
