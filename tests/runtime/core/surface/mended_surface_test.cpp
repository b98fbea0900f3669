#include "samara/core/surface/mended_surface.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samara/core/surface/surface_check.hpp"
#include "support/expect_error.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using ::testing::HasSubstr;

// The unit cube whose side at z = 1 is cut in two, with more corners along the edge where x = z = 1: those of
// the side at x = 1 have them, the other side has not.
Surface cube_with_corners_on_an_edge(int corners) {
    Surface cube;
    cube.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
    cube.corners = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5},
                    {0, 5, 4}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
    std::int32_t before = 5;
    for (int i = 1; i <= corners; ++i) {
        cube.vertices.emplace_back(1.0, i / (corners + 1.0), 1.0);
        const auto corner = static_cast<std::int32_t>(cube.vertices.size()) - 1;
        cube.corners.push_back({1, corner, before});
        before = corner;
    }
    cube.corners.push_back({1, 6, before});
    cube.corners.push_back({1, 2, 6});
    return cube;
}

// Faces without area that close the gap between the sides, as a fan.
Surface bridged(Surface cube) {
    for (std::int32_t corner = 8; corner < static_cast<std::int32_t>(cube.vertices.size()); ++corner) {
        cube.corners.push_back({corner, 6, corner == 8 ? 5 : corner - 1});
    }
    return cube;
}

void expect_a_sound_cube(const Surface& surface) {
    EXPECT_NO_THROW(require_bounding_surface(surface));
    EXPECT_NEAR(test::moments_of(surface).volume, 1.0, 1e-12);
    EXPECT_NEAR(surface_area(surface), 6.0, 1e-12);
}

TEST(MendedSurface, LeavesOutFacesWithTwoEqualCorners) {
    // Quads cut in two at the poles of a sphere: one half of each has two corners there.
    Surface sphere;
    constexpr int around = 12;
    constexpr int rows = 6;
    const auto point = [](int row, int column) {
        const double height = std::numbers::pi * row / rows;
        const double azimuth = 2.0 * std::numbers::pi * column / around;
        return Vector3d(std::sin(height) * std::cos(azimuth), std::sin(height) * std::sin(azimuth),
                        std::cos(height));
    };
    const auto add = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
        const auto first = static_cast<std::int32_t>(sphere.vertices.size());
        sphere.vertices.insert(sphere.vertices.end(), {a, b, c});
        sphere.corners.push_back({first, first + 1, first + 2});
    };
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < around; ++column) {
            add(point(row, column), point(row + 1, column), point(row + 1, column + 1));
            add(point(row, column), point(row + 1, column + 1), point(row, column + 1));
        }
    }
    const Surface result = mended(sphere);
    EXPECT_EQ(result.triangle_count(), sphere.triangle_count() - 2U * around);
    EXPECT_EQ(result.vertices.size(), 2U + around * (rows - 1U));
    EXPECT_NO_THROW(require_bounding_surface(result));
    EXPECT_NEAR(test::moments_of(result).volume, test::moments_of(sphere).volume, 1e-12);
}

TEST(MendedSurface, TurnsTheSidesOfFacesWithoutArea) {
    for (const int corners : {1, 2, 7}) {
        const Surface cube = bridged(cube_with_corners_on_an_edge(corners));
        expect_a_sound_cube(mended(cube));
    }
}

TEST(MendedSurface, SplitsFacesWhereCornersOfOthersLieOnTheirSides) {
    for (const int corners : {1, 2, 7}) expect_a_sound_cube(mended(cube_with_corners_on_an_edge(corners)));
}

TEST(MendedSurface, LeavesAHoleOpen) {
    Surface cube = cube_with_corners_on_an_edge(1);
    cube.corners.erase(cube.corners.begin());
    EXPECT_THAT(test::error_of([&] { require_bounding_surface(mended(cube)); }),
                HasSubstr("3 edges have a face on one"));
}

TEST(MendedSurface, SaysWhatIsLostFarFromTheOrigin) {
    const auto far_off = [](double distance, bool single) {
        Surface cube = cube_with_corners_on_an_edge(0);
        for (Vector3d& vertex : cube.vertices) {
            vertex.x() += distance;
            if (!single) vertex.y() += 0.1;
        }
        return cube;
    };
    const std::string error = test::error_of([&] { mended(far_off(1e6, true)); });
    EXPECT_THAT(
        error,
        HasSubstr("lies 1e+06 from the origin, where coordinates of 32 bits have a resolution of 0.12"));
    EXPECT_THAT(error, HasSubstr("move it to the origin before you export it"));
    EXPECT_NO_THROW(mended(far_off(1e2, true)));
    EXPECT_NO_THROW(mended(far_off(1e6, false))) << "coordinates of 64 bits";
}

}  // namespace
}  // namespace samara
