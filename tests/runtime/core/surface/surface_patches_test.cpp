#include "samara/core/surface/surface_patches.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/test_shapes.hpp"

namespace samara {
namespace {

/// The lengths of a box along x, y, z.
const Vector3d lengths(0.01, 0.08, 0.02);

Matrix3d spread_of(const std::vector<SurfacePatch>& patches) {
    Matrix3d spread = Matrix3d::Zero();
    for (const SurfacePatch& patch : patches) spread += patch.share * patch.place * patch.place.transpose();
    return spread;
}

TEST(SurfacePatches, OneIsTheWholeSurface) {
    const auto patches = surface_patches(test::box(lengths, 3), 1);
    ASSERT_EQ(patches.size(), 1U);
    EXPECT_DOUBLE_EQ(patches[0].share, 1.0);
    EXPECT_LT(patches[0].place.norm(), 1e-18);
}

TEST(SurfacePatches, SharesAddUpToOneAndPlacesBalance) {
    for (const int count : {2, 3, 5, 8, most_surface_patches}) {
        const auto patches = surface_patches(test::ellipsoid({0.01, 0.02, 0.04}, 2), count);
        ASSERT_EQ(patches.size(), static_cast<std::size_t>(count));
        double share = 0.0;
        Vector3d middle = Vector3d::Zero();
        for (const SurfacePatch& patch : patches) {
            EXPECT_GT(patch.share, 0.0);
            share += patch.share;
            middle += patch.share * patch.place;
        }
        EXPECT_NEAR(share, 1.0, 1e-14);
        EXPECT_LT(middle.norm(), 1e-16);
    }
}

TEST(SurfacePatches, OfALongBoxLieAlongItsLength) {
    const auto patches = surface_patches(test::box(lengths, 3), 2);
    // Of half the box without its inner face: the sides' middle lies at a quarter of the length, the end's at
    // half.
    const double sides = lengths.y() * (lengths.x() + lengths.z());
    const double ends = lengths.x() * lengths.z();
    const double place = lengths.y() * (0.25 * sides + 0.5 * ends) / (sides + ends);
    for (const SurfacePatch& patch : patches) {
        EXPECT_NEAR(patch.share, 0.5, 1e-12);
        EXPECT_NEAR(std::abs(patch.place.y()), place, 1e-12);
        EXPECT_NEAR(patch.place.x(), 0.0, 1e-12);
        EXPECT_NEAR(patch.place.z(), 0.0, 1e-12);
    }
}

TEST(SurfacePatches, DoNotDependOnTheMesh) {
    const auto coarse = surface_patches(test::box(lengths, 1), 8);
    const auto fine = surface_patches(test::box(lengths, 6), 8);
    for (const SurfacePatch& patch : coarse) {
        EXPECT_TRUE(std::ranges::any_of(fine, [&](const SurfacePatch& other) {
            return (patch.place - other.place).norm() < 1e-12 && std::abs(patch.share - other.share) < 1e-12;
        })) << patch.place.transpose();
    }
}

TEST(SurfacePatches, SpreadMoreAndMoreAsTheSurfaceDoes) {
    const Surface box = test::box(lengths, 8);
    double whole = 0.0;
    for (std::size_t t = 0; t < box.triangle_count(); ++t) {
        whole += area_vector(box, t).norm() / surface_area(box) * triangle_centroid(box, t).squaredNorm();
    }
    double before = 0.0;
    for (const int count : {2, 4, 8, 16, 32}) {
        const double spread = spread_of(surface_patches(box, count)).trace() / whole;
        EXPECT_GT(spread, before);
        EXPECT_LT(spread, 1.0);
        before = spread;
    }
    EXPECT_GT(before, 0.95);
}

}  // namespace
}  // namespace samara
