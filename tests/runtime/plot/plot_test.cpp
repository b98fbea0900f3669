#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/internal/plot/canvas.hpp"
#include "samara/internal/plot/motion_plot.hpp"
#include "samara/internal/plot/silhouette.hpp"
#include "samara/internal/plot/strip.hpp"
#include "samara/motion/motion_file.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::degree;
using test::TemporaryFolder;
using ::testing::HasSubstr;

Motion fluttering() {
    return test::motion_of([](double t) { return test::flutter(t, 1.1, 40.0 * degree, 0.2); }, 4.0);
}

Motion resting(double duration) {
    return test::motion_of([](double) { return Pose{}; }, duration);
}

std::uint32_t big_endian(const std::string& bytes, std::size_t place) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8U | static_cast<unsigned char>(bytes.at(place + i));
    return value;
}

void expect_png(const std::filesystem::path& file, std::size_t least_bytes) {
    const std::string bytes = read_bytes(file);
    ASSERT_GT(bytes.size(), least_bytes);
    EXPECT_EQ(bytes.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(big_endian(bytes, 16), 2000U);
    EXPECT_EQ(big_endian(bytes, 20), 1300U);
    EXPECT_EQ(bytes.substr(bytes.size() - 8, 4), "IEND");
}

TEST(Plot, IsAPngOfTheStatedSize) {
    const TemporaryFolder folder;
    const Motion motion = fluttering();
    const MotionPlot plot = plot_motion(folder / "motion.png", motion, motion.bodies[0]);
    expect_png(folder / "motion.png", 50000);
    EXPECT_GE(plot.silhouettes, 8);
    EXPECT_EQ(plot.measures.regime, Regime::fluttering);
    EXPECT_EQ(plot.strip.begin, 0.0);
    EXPECT_EQ(plot.strip.end, 4.0);
}

TEST(Plot, IsAnSvgWithItsTextAsTextWhereTheNameEndsSo) {
    const TemporaryFolder folder;
    Motion motion = fluttering();
    motion.bodies[0].name = "it's_{a} \\ \"leaf\"";
    plot_motion(folder / "motion.svg", motion, motion.bodies[0]);
    const std::string text = read_bytes(folder / "motion.svg");
    EXPECT_THAT(text, HasSubstr("<svg"));
    EXPECT_THAT(text, HasSubstr("</svg>"));
    EXPECT_THAT(text, HasSubstr("it's_{a} \\"));
    EXPECT_THAT(text, HasSubstr("fluttering, descends at 0.2"));
    EXPECT_THAT(text, HasSubstr("Descent speed (m/s)"));
}

TEST(Plot, ShowsBodiesAtRestAndSingleFramesAndWidePaths) {
    const TemporaryFolder folder;
    for (const double duration : {2.0, 0.0}) {
        const Motion motion = resting(duration);
        EXPECT_EQ(plot_motion(folder / "rest.png", motion, motion.bodies[0]).silhouettes, 1);
        expect_png(folder / "rest.png", 20000);
    }
    Motion motion = test::motion_of([](double t) { return test::tumble(20.0 * t, 1.0, 0.01); }, 2.0);
    motion.gravity = Vector3d::Zero();
    EXPECT_GT(plot_motion(folder / "wide.png", motion, motion.bodies[0]).silhouettes, 8);
    expect_png(folder / "wide.png", 20000);
}

TEST(Plot, SaysWhatIsMissingWithoutGnuplot) {
    const TemporaryFolder folder;
    write_motion_file(folder / "motion.h5", fluttering());
    const int status =
        run_subprocess({"/usr/bin/env", "PATH=" + folder.path().string(), SAMARA_PROGRAMS "/samara", "plot",
                        folder / "motion.h5", "-o", folder / "motion.png"},
                       folder / "log");
    EXPECT_EQ(status, 1);
    EXPECT_THAT(read_bytes(folder / "log"), HasSubstr("apt install gnuplot-nox"));
    EXPECT_FALSE(std::filesystem::exists(folder / "motion.png"));
}

TEST(PlotCommand, DrawsTheBodyRunAndCopyAskedForAndNamesWhatIsThereOtherwise) {
    const TemporaryFolder folder;
    Motion motion = fluttering();
    BodyMotion second = test::motion_of([](double t) { return test::tumble(t, 8.0, 0.4); }, 4.0).bodies[0];
    second.name = "plate";
    motion.bodies.push_back(second);
    write_motion_file(folder / "motion.h5", motion);
    const auto run = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {SAMARA_PROGRAMS "/samara", "plot", folder / "motion.h5", "-o",
                                          folder / "motion.png"};
        words.insert(words.end(), more.begin(), more.end());
        return run_subprocess(words, folder / "log");
    };
    ASSERT_EQ(run({"--body", "plate", "--json"}), 0) << read_bytes(folder / "log");
    expect_png(folder / "motion.png", 20000);
    const auto json = nlohmann::json::parse(read_bytes(folder / "log"));
    EXPECT_EQ(json["body"], "plate");
    EXPECT_EQ(json["measures"]["regime"], "tumbling");
    EXPECT_NEAR(json["measures"]["descent_speed"].get<double>(), 0.4, 1e-9);
    EXPECT_EQ(run({"--body", "leaf"}), 1);
    EXPECT_THAT(read_bytes(folder / "log"), HasSubstr("holds no body 'leaf'; it holds: ellipsoid, plate"));
    EXPECT_EQ(run({"--copy", "1"}), 1);
    EXPECT_THAT(read_bytes(folder / "log"), HasSubstr("there is no copy 1"));
    EXPECT_EQ(run({"--run", "3"}), 1);
    EXPECT_THAT(read_bytes(folder / "log"), HasSubstr("there is no run 3"));
}

TEST(PlotCommand, RefusesFormatsItCannotDrawAndFoldersThatAreNotThere) {
    const TemporaryFolder folder;
    write_motion_file(folder / "motion.h5", fluttering());
    const auto run = [&](const std::string& output) {
        return run_subprocess({SAMARA_PROGRAMS "/samara", "plot", folder / "motion.h5", "-o", output},
                              folder / "log");
    };
    EXPECT_EQ(run(folder / "motion.pdf"), 1);
    EXPECT_THAT(read_bytes(folder / "log"), HasSubstr(".png or .svg"));
    EXPECT_EQ(run(folder / "none/motion.png"), 1);
    EXPECT_THAT(read_bytes(folder / "log"), HasSubstr("does not exist"));
}

TEST(Strip, SilhouettesFollowAtEvenTimesWithoutSmearing) {
    const Motion motion =
        test::motion_of([](double t) { return test::flutter(t, 1.1, 40.0 * degree, 0.2); }, 4.0);
    const Strip strip = choose_strip(motion, motion.bodies[0], 0, 0);
    ASSERT_GE(strip.frames.size(), 8U);
    ASSERT_LE(strip.frames.size(), 40U);
    for (std::size_t i = 2; i < strip.frames.size(); ++i) {
        EXPECT_EQ(strip.frames[i] - strip.frames[i - 1], strip.frames[1] - strip.frames[0]);
    }
}

TEST(Strip, SilhouettesOfASinkingEllipsoidNearlyTouch) {
    // 2 cm thick, sinking at 0.28 m/s and 60 frames per second: apart after 4.3 frames.
    const auto sinking = [](double t) {
        Pose pose;
        pose.position.z() = -0.28 * t;
        pose.velocity.z() = -0.28;
        return pose;
    };
    const Motion motion = test::motion_of(sinking, 2.0);
    const Strip strip = choose_strip(motion, motion.bodies[0], 0, 0);
    ASSERT_GE(strip.frames.size(), 2U);
    EXPECT_EQ(strip.frames[1] - strip.frames[0], 5);
}

TEST(Strip, OfALongFallItIsTheLastStretch) {
    const auto sinking = [](double t) {
        Pose pose;
        pose.position.z() = -t;
        pose.velocity.z() = -1.0;
        return pose;
    };
    const Motion motion = test::motion_of(sinking, 20.0);
    const Strip strip = choose_strip(motion, motion.bodies[0], 0, 0);
    EXPECT_EQ(strip.last, 1200);
    EXPECT_NEAR(motion.times[1200] - motion.times[static_cast<std::size_t>(strip.first)], 24.0 * 0.08, 0.05);
}

TEST(Silhouette, ShowsTheSideTurnedToTheViewer) {
    const ShadedMesh cube = shaded_mesh(test::box({2.0, 2.0, 2.0}, 1));
    ShapePose pose;
    pose.position = Vector3d(5.0, 6.0, 7.0);
    const Color color(0.2, 0.4, 0.6);
    const auto painted = painted_silhouette(cube, pose, front_view(), color, 0.0, 0.0);
    double area = 0.0;
    for (const PaintedTriangle& triangle : painted) {
        const Vector2d a = triangle.corners[1] - triangle.corners[0];
        const Vector2d b = triangle.corners[2] - triangle.corners[0];
        area += 0.5 * std::abs(a.x() * b.y() - a.y() * b.x());
        for (const Vector2d& corner : triangle.corners) {
            EXPECT_NEAR(std::abs(corner.x() - 5.0), 1.0, 1e-12);
            EXPECT_NEAR(std::abs(corner.y() - 7.0), 1.0, 1e-12);
        }
    }
    EXPECT_NEAR(area, 4.0, 1e-12);
    const auto from_the_side = painted_silhouette(cube, pose, side_view(), color, 0.0, 0.0);
    EXPECT_NEAR(std::abs(from_the_side[0].corners[0].x() - 6.0), 1.0, 1e-12);
}

TEST(Silhouette, UpperSidesAreBrighterThanLowerOnes) {
    const ShadedMesh ball = shaded_mesh(test::ellipsoid({1.0, 1.0, 1.0}, 3));
    double upper = 0.0;
    double lower = 0.0;
    for (const PaintedTriangle& triangle :
         painted_silhouette(ball, ShapePose{}, front_view(), Color(0.5, 0.5, 0.5), 0.0, 0.0)) {
        const double height = (triangle.corners[0] + triangle.corners[1] + triangle.corners[2]).y();
        if (height > 2.0) upper = std::max(upper, static_cast<double>(triangle.color & 0xffU));
        if (height < -2.0) lower = std::max(lower, static_cast<double>(triangle.color & 0xffU));
    }
    EXPECT_GT(upper, lower + 20.0);
}

TEST(Silhouette, LargeSurfacesAreSimplifiedToTheSameForm) {
    const Surface fine = test::ellipsoid({0.04, 0.02, 0.01}, 5);
    const Surface coarse = simplified_surface(fine, 3000);
    EXPECT_LE(coarse.triangle_count(), 3000U);
    EXPECT_GT(coarse.triangle_count(), 300U);
    EXPECT_NEAR(surface_area(coarse), surface_area(fine), 0.05 * surface_area(fine));
    EXPECT_EQ(simplified_surface(fine, 1000000).corners, fine.corners);
}

TEST(Canvas, TicsAreOneTwoOrFiveTimesAPowerOfTen) {
    EXPECT_DOUBLE_EQ(tic_step(0.011), 0.02);
    EXPECT_DOUBLE_EQ(tic_step(0.1), 0.1);
    EXPECT_DOUBLE_EQ(tic_step(3.0), 5.0);
    EXPECT_DOUBLE_EQ(tic_step(6.0), 10.0);
}

}  // namespace
}  // namespace samara
