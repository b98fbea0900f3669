#include "samara/core/surface/silhouette.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/test_shapes.hpp"

namespace samara {
namespace {

Silhouette along(const Surface& surface, const Vector3d& direction) {
    return silhouettes(surface, {direction.normalized()}).front();
}

TEST(Silhouette, OfACubeRunsAlongSharpEdges) {
    const Surface cube = test::box({2.0, 2.0, 2.0}, 4);
    for (const Vector3d& direction : {Vector3d(1, 0, 0), Vector3d(0, -1, 0), Vector3d(1, 2, 3)}) {
        EXPECT_NEAR(along(cube, direction).edge_share, 1.0, 1e-12);
    }
    EXPECT_NEAR(along(cube, {1, 0, 0}).depth, 1.0, 1e-12);
}

TEST(Silhouette, OfABallHasNoEdge) {
    const Silhouette ball = along(test::icosphere(3), {1, 2, 3});
    EXPECT_EQ(ball.edge_share, 0.0);
    EXPECT_NEAR(ball.depth, 4.0 / 3.0 / std::sqrt(std::numbers::pi), 0.02);
}

TEST(Silhouette, OfAThinPlateHasNoDepthBroadsideAndMuchOnEdge) {
    const Surface plate = test::box({1.0, 1.0, 0.01}, 10);
    EXPECT_NEAR(along(plate, {0, 0, 1}).depth, 0.01, 1e-9);
    EXPECT_NEAR(along(plate, {1, 0, 0}).depth, 0.01 / std::pow(0.01, 1.5), 1e-6);
}

TEST(Silhouette, KnowsNeitherSizeNorPlaceNorTheSenseOfADirectionAcrossAPrism) {
    const Surface box = test::box({1.0, 0.6, 0.1}, 5);
    const Surface other = test::mapped(box, 30.0 * Matrix3d::Identity(), {4.0, -2.0, 9.0});
    const Vector3d direction(0.3, -0.5, 0.8);
    EXPECT_NEAR(along(box, direction).edge_share, along(other, direction).edge_share, 1e-9);
    EXPECT_NEAR(along(box, direction).depth, along(other, direction).depth, 1e-9);
    EXPECT_NEAR(along(box, direction).depth, along(box, -direction).depth, 1e-9);
}

}  // namespace
}  // namespace samara
