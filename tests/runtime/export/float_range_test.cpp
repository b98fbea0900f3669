#include "samara/export/float_range.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/export/chan_file.hpp"
#include "samara/export/gltf_file.hpp"
#include "samara/export/page_file.hpp"
#include "samara/export/usd_file.hpp"
#include "support/expect_error.hpp"
#include "support/temporary_folder.hpp"
#include "synthetic_motion.hpp"

namespace samara {
namespace {

using testing::AllOf;
using testing::HasSubstr;

/// What is beyond single precision is rejected by every format of floats, and leaves no file.
void expect_rejection(const Motion& motion, const std::string& what) {
    const test::TemporaryFolder folder;
    const auto expected = AllOf(HasSubstr("out."), HasSubstr(what));
    EXPECT_THAT(test::error_of([&] { write_glb(folder / "out.glb", motion, 0, {}); }), expected);
    EXPECT_THAT(test::error_of([&] { write_usda(folder / "out.usda", motion, 0, {}); }), expected);
    EXPECT_THAT(test::error_of([&] { (void)write_chan(folder / "out.chan", motion, 0, {}); }), expected);
    if (has_page()) {
        EXPECT_THAT(test::error_of([&] { write_page(folder / "out.html", motion, 0, "", ""); }), expected);
    }
    EXPECT_EQ(folder.file_count(), 0);
}

class FloatRange : public testing::Test {
  protected:
    BodyMotion& body() { return motion_.bodies[0]; }

    Motion motion_ = test::motion_of(test::wander, 0.1);
};

TEST_F(FloatRange, HoldsWhatAMotionIsMadeOf) {
    EXPECT_NO_THROW(require_float_range("out.glb", motion_, 0));
}

TEST_F(FloatRange, EndsForSurfaces) {
    body().surface.vertices[0].x() = 1e39;
    expect_rejection(motion_, "vertices of 'ellipsoid' exceed 1e+37");
}

TEST_F(FloatRange, EndsForSizes) {
    body().sizes = {1e300};
    expect_rejection(motion_, "vertices of 'ellipsoid' exceed");
}

TEST_F(FloatRange, EndsForDisplayMeshes) {
    DisplayMesh display;
    display.positions = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, -1e300, 0.0}};
    display.corners = {{0, 1, 2}};
    display.slots = {0};
    display.materials.resize(1);
    body().display = std::make_shared<const DisplayMesh>(display);
    expect_rejection(motion_, "vertices of the display mesh of 'ellipsoid' exceed");
    display.positions[2].y() = 1.0;
    display.texture.assign(3, Eigen::Vector2d(1e300, 0.0));
    body().display = std::make_shared<const DisplayMesh>(display);
    expect_rejection(motion_, "texture coordinates of 'ellipsoid' exceed");
}

TEST_F(FloatRange, EndsForPlacesAndVelocities) {
    body().poses[1].position.z() = -1e39;
    expect_rejection(motion_, "places of 'ellipsoid' exceed");
    body().poses[1].position.z() = 0.0;
    body().poses[2].velocity.x() = 1e300;
    expect_rejection(motion_, "velocities of 'ellipsoid' exceed");
}

TEST_F(FloatRange, EndsForTimes) {
    motion_.frame_rate = 1.0;
    for (std::size_t i = 0; i < motion_.times.size(); ++i) motion_.times[i] = static_cast<double>(i);
    motion_.times.back() = 1e300;
    expect_rejection(motion_, "exceed 1e+37");
}

TEST_F(FloatRange, EndsForObstacles) {
    Obstacle table;
    table.name = "table";
    table.surface = test::box({1.0, 1.0, 1.0}, 1);
    table.keys = {{{}, 0.0}};
    table.keys[0].position.x() = 1e39;
    motion_.obstacles = {table};
    expect_rejection(motion_, "places of 'table' exceed");
}

}  // namespace
}  // namespace samara
