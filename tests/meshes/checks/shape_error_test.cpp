#include "meshes/checks/shape_error.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/test_shapes.hpp"

namespace samara {
namespace {

TEST(ShapeError, OfASurfaceAgainstItselfIsNothing) {
    const Surface ball = test::icosphere(2);
    const ShapeError error = shape_error(ball, ball);
    EXPECT_NEAR(error.distance, 0.0, 1e-12);
    EXPECT_NEAR(error.mean_distance, 0.0, 1e-12);
    EXPECT_NEAR(error.volume, 0.0, 1e-12);
    EXPECT_NEAR(error.area, 0.0, 1e-12);
    EXPECT_LT(miss_of(error), 1e-6);
}

TEST(ShapeError, TellsDistanceVolumeAndAreaOfABoxThatIsHigher) {
    const Surface box = test::box(Vector3d(1.0, 1.0, 1.0), 4);
    const Surface higher = test::box(Vector3d(1.0, 1.0, 1.02), 4);
    const ShapeError error = shape_error(box, higher);
    EXPECT_NEAR(error.distance, 0.01 / std::sqrt(3.0), 1e-9);
    EXPECT_NEAR(error.volume, 0.02, 1e-9);
    EXPECT_NEAR(error.area, 0.08 / 6.0, 1e-9);
    // Two of six faces are 0.01 away, and a little of the others.
    EXPECT_NEAR(error.mean_distance, 0.01 / 3.0, 3e-4);
    EXPECT_NEAR(miss_of(error), 4.0, 1e-6);
}

TEST(ShapeError, SeesWhatEitherSurfaceLacks) {
    const Surface ball = test::icosphere(3);
    const Surface other = test::mapped(ball, 0.2 * Matrix3d::Identity(), Vector3d(3.0, 0.0, 0.0));
    const Surface both = test::together({ball, other});
    EXPECT_GT(miss_of(shape_error(both, ball)), 10.0);
    EXPECT_GT(miss_of(shape_error(ball, both)), 10.0);
}

TEST(ShapeError, RoundedFacetsAreNoMissWhereTheyAreMeant) {
    const Surface facets = test::icosphere(3);
    const Surface ball = test::icosphere(6);
    const ShapeError error = shape_error(facets, ball);
    EXPECT_GT(miss_of(error), 1.0);
    EXPECT_LT(miss_of(error, smoothing_of(facets).volume), 1.0);
}

TEST(Smoothing, OfABallOfFacetsIsTheVolumeThatTheyLeaveOut) {
    for (const int level : {2, 3, 4}) {
        const Surface facets = test::icosphere(level);
        const double left_out = 4.0 / 3.0 * std::numbers::pi / test::moments_of(facets).volume - 1.0;
        const Smoothing smoothing = smoothing_of(facets);
        EXPECT_NEAR(smoothing.volume, left_out, 0.1 * left_out);
        EXPECT_DOUBLE_EQ(smoothing.volume, smoothing.between);
    }
}

TEST(Smoothing, OfABoxIsNothing) {
    EXPECT_NEAR(smoothing_of(test::box(Vector3d(1.0, 2.0, 0.1), 5)).between, 0.0, 1e-12);
}

}  // namespace
}  // namespace samara
