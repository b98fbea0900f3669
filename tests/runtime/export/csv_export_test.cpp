#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "paths.hpp"
#include "samara/commands/shared/subprocess.hpp"
#include "samara/core/files/content_hash.hpp"
#include "samara/export/csv_file.hpp"
#include "samara/motion/motion_file.hpp"
#include "samara/motion/resample.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using test::TemporaryFolder;

Motion motion_with_runs_and_copies() {
    Motion motion = test::motion_of([](double t) { return test::tumble(t, 9.0, 0.3); }, 1.0, 100.0);
    motion.runs = 2;
    BodyMotion& body = motion.bodies[0];
    body.copies = 3;
    body.center_of_mass = Vector3d(0.01, 0.02, -0.03);
    body.poses.clear();
    for (int run = 0; run < 2; ++run) {
        for (const double time : motion.times) {
            for (int copy = 0; copy < 3; ++copy) {
                body.poses.push_back(test::tumble(time, 9.0 + run, 0.3 + copy));
            }
        }
    }
    return motion;
}

std::vector<std::vector<std::string>> rows_of(const std::filesystem::path& file) {
    std::istringstream stream(read_bytes(file));
    std::vector<std::vector<std::string>> rows;
    for (std::string line; std::getline(stream, line);) {
        std::istringstream fields(line);
        rows.emplace_back();
        for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
    }
    return rows;
}

TEST(CsvExport, HasARowForEachRunBodyCopyAndFrame) {
    const TemporaryFolder folder;
    const Motion motion = motion_with_runs_and_copies();
    EXPECT_EQ(write_csv(folder / "motion.csv", motion), 2U * 3U * 101U);
    const auto rows = rows_of(folder / "motion.csv");
    ASSERT_EQ(rows.size(), 1U + 2U * 3U * 101U);
    EXPECT_EQ(rows[0],
              (std::vector<std::string>{"run", "body", "copy", "time", "position_x", "position_y",
                                        "position_z", "orientation_w", "orientation_x", "orientation_y",
                                        "orientation_z", "velocity_x", "velocity_y", "velocity_z",
                                        "angular_velocity_x", "angular_velocity_y", "angular_velocity_z"}));
    const auto& row = rows[1 + (1 * 3 + 2) * 101 + 50];
    ASSERT_EQ(row.size(), 17U);
    EXPECT_EQ(row[0], "1");
    EXPECT_EQ(row[1], "ellipsoid");
    EXPECT_EQ(row[2], "2");
    EXPECT_EQ(row[3], "0.5");
    const Pose& pose = motion.pose(motion.bodies[0], 1, 50, 2);
    const Vector3d origin = shape_origin(pose, motion.bodies[0].center_of_mass);
    EXPECT_EQ(std::stod(row[4]), origin.x());
    EXPECT_EQ(std::stod(row[6]), origin.z());
    EXPECT_EQ(std::stod(row[15]), 10.0);
}

TEST(CsvExport, ForcesOfAMotionThatHasThemAreColumns) {
    const TemporaryFolder folder;
    Motion motion = motion_with_runs_and_copies();
    motion.has_forces = true;
    BodyMotion& body = motion.bodies[0];
    body.forces.resize(body.poses.size());
    body.forces[motion.index(body, 1, 50, 2)].drag = {Vector3d(4.0, 5.0, 6.0), Vector3d(1.0, 2.0, 3.0)};
    write_csv(folder / "motion.csv", motion);
    const auto rows = rows_of(folder / "motion.csv");
    const auto column = std::find(rows[0].begin(), rows[0].end(), "drag_moment_x") - rows[0].begin();
    ASSERT_EQ(rows[0].size(), 17U + 30U);
    bool found = false;
    for (const auto& row : rows) {
        if (row[0] != "1" || row[2] != "2" || row[3] != "0.5") continue;
        found = true;
        for (int i = 0; i < 6; ++i) {
            EXPECT_EQ(std::stod(row[static_cast<std::size_t>(column + i)]), i + 1.0);
        }
    }
    EXPECT_TRUE(found);
}

TEST(CsvExport, VelocityIsTheDerivativeOfThePosition) {
    const TemporaryFolder folder;
    write_csv(folder / "motion.csv", motion_with_runs_and_copies());
    const auto rows = rows_of(folder / "motion.csv");
    for (const std::size_t row : {20U, 60U, 333U}) {
        for (const std::size_t axis : {0U, 1U, 2U}) {
            const double difference =
                (std::stod(rows[row + 1][4 + axis]) - std::stod(rows[row - 1][4 + axis])) / 0.02;
            EXPECT_NEAR(std::stod(rows[row][11 + axis]), difference, 1e-3);
        }
    }
}

TEST(CsvExport, QuaternionsKeepTheirSign) {
    const TemporaryFolder folder;
    Motion motion = test::motion_of([](double t) { return test::tumble(t, 9.0, 0.3); }, 1.0);
    for (std::size_t i = 0; i < motion.bodies[0].poses.size(); i += 3) {
        motion.bodies[0].poses[i].orientation.coeffs() *= -1.0;
    }
    write_csv(folder / "motion.csv", motion);
    const auto rows = rows_of(folder / "motion.csv");
    for (std::size_t row = 2; row < rows.size(); ++row) {
        double product = 0.0;
        for (std::size_t i = 7; i < 11; ++i) product += std::stod(rows[row][i]) * std::stod(rows[row - 1][i]);
        EXPECT_GT(product, 0.9);
    }
}

TEST(CsvExport, NamesWithCommasAreQuoted) {
    const TemporaryFolder folder;
    Motion motion = test::motion_of([](double) { return Pose{}; }, 0.0);
    motion.bodies[0].name = "leaf, \"red\"";
    write_csv(folder / "motion.csv", motion);
    EXPECT_NE(read_bytes(folder / "motion.csv").find("\n0,\"leaf, \"\"red\"\"\",0,0,"), std::string::npos);
}

TEST(ExportCommand, WritesAllRunsOrTheOneAskedFor) {
    const TemporaryFolder folder;
    write_motion_file(folder / "motion.h5", motion_with_runs_and_copies());
    const std::string program = SAMARA_PROGRAMS "/samara";
    const auto run = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {program, "export", folder / "motion.h5", "-o",
                                          folder / "motion.csv"};
        words.insert(words.end(), more.begin(), more.end());
        return run_subprocess(words, folder / "log");
    };
    ASSERT_EQ(run({}), 0);
    EXPECT_EQ(rows_of(folder / "motion.csv").size(), 1U + 606U);
    ASSERT_EQ(run({"--run", "1", "--json"}), 0);
    const auto rows = rows_of(folder / "motion.csv");
    EXPECT_EQ(rows.size(), 1U + 303U);
    EXPECT_EQ(rows[1][0], "1");
    EXPECT_NE(read_bytes(folder / "log").find("\"rows\":303"), std::string::npos);
    EXPECT_EQ(run({"--run", "2"}), 1);
    EXPECT_NE(read_bytes(folder / "log").find("not run 2"), std::string::npos);
}

TEST(ExportCommand, WritesTheFrameRateAskedForInEveryFormat) {
    const TemporaryFolder folder;
    const Motion motion = motion_with_runs_and_copies();
    write_motion_file(folder / "motion.h5", motion);
    write_csv(folder / "expected.csv", resampled(motion, 24.0), 0);
    for (const char* name : {"motion.csv", "motion.glb", "motion.usda", "motion.chan"}) {
        ASSERT_EQ(run_subprocess({SAMARA_PROGRAMS "/samara", "export", folder / "motion.h5", "-o",
                                  folder / name, "--frame-rate", "24", "--run", "0", "--json"},
                                 folder / "log"),
                  0)
            << read_bytes(folder / "log");
        const auto result = nlohmann::json::parse(read_bytes(folder / "log"));
        EXPECT_EQ(result["frames"], 25);
        EXPECT_EQ(result["frame_rate"], 24.0);
    }
    EXPECT_EQ(read_bytes(folder / "motion.csv"), read_bytes(folder / "expected.csv"));
}

TEST(ExportCommand, RefusesAToleranceWhereEveryFrameIsWritten) {
    const TemporaryFolder folder;
    write_motion_file(folder / "motion.h5", motion_with_runs_and_copies());
    EXPECT_EQ(run_subprocess({SAMARA_PROGRAMS "/samara", "export", folder / "motion.h5", "-o",
                              folder / "motion.chan", "--tolerance", "1e-4"},
                             folder / "log"),
              1);
    EXPECT_NE(read_bytes(folder / "log").find("--tolerance applies to .glb and .usda"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(folder / "motion.chan"));
}

TEST(ExportCommand, RefusesUnknownFormatsAndMissingFiles) {
    const TemporaryFolder folder;
    const std::string program = SAMARA_PROGRAMS "/samara";
    EXPECT_EQ(run_subprocess({program, "export", "none.h5", "-o", folder / "motion.xyz"}, folder / "log"), 1);
    EXPECT_NE(read_bytes(folder / "log").find(".chan, .html or .csv"), std::string::npos);
    EXPECT_EQ(run_subprocess({program, "export", "none.h5", "-o", folder / "motion.csv"}, folder / "log"), 1);
    EXPECT_NE(read_bytes(folder / "log").find("none.h5: does not exist; check the name"), std::string::npos);
}

}  // namespace
}  // namespace samara
