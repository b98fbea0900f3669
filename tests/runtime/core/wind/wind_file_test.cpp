#include "samara/core/wind/wind_file.hpp"

#include <fstream>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/core/body/body_file.hpp"
#include "samara/motion/file_check.hpp"
#include "support/expect_error.hpp"
#include "support/known_bodies.hpp"
#include "support/temporary_folder.hpp"

namespace samara {
namespace {

using test::error_of;
using testing::HasSubstr;

WindGrid small_grid() {
    WindGrid grid;
    grid.origin = Vector3d(1.0, -2.0, 0.5);
    grid.spacing = Vector3d(0.5, 0.25, 1.0);
    grid.nodes = {4, 3, 2};
    grid.frames = 3;
    grid.interval = 0.04;
    grid.source = "numbers in order";
    for (std::size_t i = 0; i < grid.size(); ++i) grid.velocities.push_back(0.1F * static_cast<float>(i));
    return grid;
}

class WindFileTest : public testing::Test {
  protected:
    std::filesystem::path file_of(const WindGrid& grid) {
        const std::filesystem::path file = folder_.path() / "gust.h5";
        write_wind_file(file, grid);
        return file;
    }
    test::TemporaryFolder folder_;
};

TEST_F(WindFileTest, GivesBackWhatWasWritten) {
    const WindGrid grid = small_grid();
    const std::filesystem::path file = file_of(grid);
    const WindGrid read = read_wind_file(file);
    EXPECT_EQ(read.origin, grid.origin);
    EXPECT_EQ(read.spacing, grid.spacing);
    EXPECT_EQ(read.nodes, grid.nodes);
    EXPECT_EQ(read.frames, grid.frames);
    EXPECT_EQ(read.interval, grid.interval);
    EXPECT_EQ(read.velocities, grid.velocities);
    EXPECT_EQ(read.source, grid.source);
    EXPECT_EQ(read.hash.size(), 32U);
    EXPECT_EQ(read_wind_file(file_of(grid)).hash, read.hash);
    EXPECT_EQ(check_file(file).kind, "wind");
}

TEST_F(WindFileTest, DamageIsRefused) {
    const std::filesystem::path file = file_of(small_grid());
    const auto size = std::filesystem::file_size(file);
    {
        std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
        stream.seekp(static_cast<std::streamoff>(size / 2));
        stream.put('\x7f');
    }
    EXPECT_THAT(error_of([&] { read_wind_file(file); }), HasSubstr("gust.h5"));
    std::filesystem::resize_file(file_of(small_grid()), size / 2);
    EXPECT_THAT(error_of([&] { read_wind_file(file); }), HasSubstr("gust.h5"));
    EXPECT_THAT(error_of([&] { read_wind_file(folder_.path() / "nowhere.h5"); }), HasSubstr("nowhere.h5"));
    Body body = test::exact_sphere(0.1);
    body.name = "ball";
    body.source = "invented";
    write_body_file(file, body);
    EXPECT_THAT(error_of([&] { read_wind_file(file); }), HasSubstr("is not a wind file"));
}

TEST_F(WindFileTest, WhatBreaksARuleIsRefused) {
    WindGrid grid = small_grid();
    grid.velocities[20] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THAT(error_of([&] { read_wind_file(file_of(grid)); }), HasSubstr("finite"));
    grid = small_grid();
    grid.spacing.y() = 0.0;
    EXPECT_THAT(error_of([&] { read_wind_file(file_of(grid)); }), HasSubstr("/wind/spacing"));
    grid = small_grid();
    grid.interval = -1.0;
    EXPECT_THAT(error_of([&] { read_wind_file(file_of(grid)); }), HasSubstr("interval"));
}

}  // namespace
}  // namespace samara
