#include "samara/kirchhoff/surfaces/surface_ladder.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "samara/core/surface/curved_surface.hpp"
#include "samara/core/surface/surface_check.hpp"
#include "support/ground_bodies.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

/// A disc whose caps are fans about their centres.
Surface fans() {
    return test::disc(1.0, 0.1, 1000);
}

TEST(NearPairs, AreSomeTenForEachTriangleOfAGoodShapeAndAllOfAFan) {
    const Surface sphere = test::icosphere(4);
    const auto count = static_cast<double>(sphere.triangle_count());
    EXPECT_GT(near_pairs(sphere), 5.0 * count);
    EXPECT_LT(near_pairs(sphere), 20.0 * count);
    const Surface slivers = fans();
    const double all = 0.5 * static_cast<double>(slivers.triangle_count() * slivers.triangle_count());
    EXPECT_GT(near_pairs(slivers), 0.25 * all);
    EXPECT_TRUE(too_many_near_pairs(slivers));
}

TEST(SurfaceLadder, ThinsOutSliversAndKeepsTheVolume) {
    const Surface slivers = fans();
    SurfaceLadder ladder(slivers);
    const Surface& base = ladder.base().surface;
    EXPECT_LT(2 * base.triangle_count(), slivers.triangle_count());
    EXPECT_FALSE(too_many_near_pairs(base));
    EXPECT_NO_THROW(require_bounding_surface(base));
    const double change = std::abs(enclosed_volume(base) / enclosed_volume(slivers) - 1.0);
    EXPECT_DOUBLE_EQ(ladder.lost_volume(), change);
    EXPECT_LT(change, lost_volume_allowed);
}

TEST(SurfaceLadder, KeepsTheTrianglesOfGoodShapes) {
    for (const Surface& surface : {test::box({1.0, 1.0, 1e-3}, 20), test::icosphere(4),
                                   test::ellipsoid({1.0, 0.05, 0.05}, 4), test::disc(1.0, 0.1)}) {
        const SurfaceLadder ladder(surface);
        EXPECT_EQ(ladder.base().surface.triangle_count(), surface.triangle_count());
        EXPECT_EQ(ladder.lost_volume(), 0.0);
    }
}

}  // namespace
}  // namespace samara
