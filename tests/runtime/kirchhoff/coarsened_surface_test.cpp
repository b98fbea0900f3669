#include <algorithm>

#include <gtest/gtest.h>

#include "samara/core/surface/surface_check.hpp"
#include "samara/kirchhoff/surfaces/refinement.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

Surface coarsened(const Surface& surface, std::size_t most_triangles) {
    return samara::coarsened({surface, find_creases(surface)}, most_triangles).surface;
}

TEST(CoarsenedSurface, IsClosedAndHasFewerTriangles) {
    for (const Surface& surface : {test::icosphere(3), test::mapped(test::shaken_icosphere(3, 0.3, 4),
                                                                    Vector3d(1.0, 2.0, 4.0).asDiagonal())}) {
        const Surface coarse = coarsened(surface, surface.triangle_count() / 2);
        EXPECT_LE(coarse.triangle_count(), surface.triangle_count() / 2);
        EXPECT_GE(coarse.triangle_count(), surface.triangle_count() / 8);
        EXPECT_NO_THROW(require_bounding_surface(coarse));
        EXPECT_EQ(coarse.vertices.size(), coarse.triangle_count() / 2 + 2);  // Euler: genus 0
    }
}

TEST(CoarsenedSurface, HasVerticesOfTheGivenOne) {
    const Surface surface = test::ellipsoid({1.0, 2.0, 3.0}, 2);
    for (const Vector3d& vertex : coarsened(surface, 100).vertices) {
        EXPECT_NE(std::find(surface.vertices.begin(), surface.vertices.end(), vertex),
                  surface.vertices.end());
    }
}

TEST(CoarsenedSurface, KeepsTheCreasesOfABox) {
    const Surface surface = test::box({1.0, 2.0, 0.3}, 8);
    const Surface coarse = coarsened(surface, surface.triangle_count() / 4);
    EXPECT_LT(coarse.triangle_count(), surface.triangle_count() / 3);
    EXPECT_NEAR(test::moments_of(coarse).volume, 0.6, 1e-12);
    EXPECT_NEAR(surface_area(coarse), surface_area(surface), 1e-12);
}

TEST(CoarsenedSurface, OfTwelveTrianglesOfABoxIsTheBox) {
    EXPECT_EQ(coarsened(test::box({1.0, 1.0, 1.0}, 1), 3).triangle_count(), 12U);
}

TEST(CoarsenedSurface, OfASmoothBodyHasNoCreasesAndOfABoxKeepsThem) {
    const Surface smooth = test::ellipsoid({1.0, 2.0, 4.0}, 3);
    const CreasedSurface coarse = samara::coarsened({smooth, find_creases(smooth)}, 80);
    EXPECT_TRUE(any_crease(find_creases(coarse.surface)));
    EXPECT_FALSE(any_crease(coarse.creases));
    const Surface cube = test::box({1.0, 1.0, 1.0}, 4);
    EXPECT_TRUE(any_crease(samara::coarsened({cube, find_creases(cube)}, 60).creases));
}

}  // namespace
}  // namespace samara
