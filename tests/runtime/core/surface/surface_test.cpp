#include "samara/core/surface/surface.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "support/test_shapes.hpp"

namespace samara {
namespace {

TEST(Surface, AreaVectorsOfAClosedSurfaceSumToZero) {
    const Surface surface = test::ellipsoid({1.0, 2.0, 4.0}, 2);
    Vector3d sum = Vector3d::Zero();
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) sum += area_vector(surface, t);
    EXPECT_LT(sum.norm(), 1e-13);
}

TEST(Surface, AreaVectorsPointOutward) {
    const Surface surface = test::box({1.0, 2.0, 3.0}, 3);
    for (std::size_t t = 0; t < surface.triangle_count(); ++t) {
        EXPECT_GT(area_vector(surface, t).dot(triangle_centroid(surface, t)), 0.0);
    }
}

TEST(Surface, AreaOfABoxIsThatOfItsFaces) {
    EXPECT_NEAR(surface_area(test::box({1.0, 2.0, 3.0}, 4)), 22.0, 1e-12);
}

TEST(Surface, AreaOfTheSphereConvergesFromBelow) {
    const double coarse = 4.0 * std::numbers::pi - surface_area(test::icosphere(2));
    const double fine = 4.0 * std::numbers::pi - surface_area(test::icosphere(3));
    EXPECT_GT(fine, 0.0);
    EXPECT_NEAR(coarse / fine, 4.0, 0.1);
}

TEST(Surface, ProjectedAreaOfTheSphereIsADiscFromEverySide) {
    const Surface sphere = test::icosphere(4);
    for (const Vector3d& direction : {Vector3d(0, 0, 1), Vector3d(1, 2, -2), Vector3d(-1, 1, 0)}) {
        EXPECT_NEAR(projected_area(sphere, direction.normalized()), std::numbers::pi,
                    0.005 * std::numbers::pi);
    }
}

TEST(Surface, ProjectedAreaOfACubeIsOneAlongAnAxisAndRootThreeAlongItsDiagonal) {
    const Surface cube = test::box({1.0, 1.0, 1.0}, 2);
    EXPECT_NEAR(projected_area(cube, Vector3d::UnitX()), 1.0, 1e-14);
    EXPECT_NEAR(projected_area(cube, Vector3d::Ones().normalized()), std::sqrt(3.0), 1e-14);
}

TEST(Surface, ReferenceLengthOfTheSphereIsItsDiameter) {
    EXPECT_DOUBLE_EQ(reference_length(4.0 * std::numbers::pi * 0.25), 1.0);
}

}  // namespace
}  // namespace samara
