#include "meshes/reading/thickened_sheet.hpp"

#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "meshes/checks/sound_surface.hpp"
#include "samara/core/surface/surface_edges.hpp"
#include "support/expect_error.hpp"
#include "support/obstacles.hpp"
#include "support/test_shapes.hpp"

namespace samara {
namespace {

using testing::HasSubstr;

/// Two squares of 1 m with the angle (rad) between them, which share a side.
Surface folded(double angle) {
    Surface sheet;
    const Vector3d far(-std::cos(angle), 0.0, std::sin(angle));
    sheet.vertices = {{0, 0, 0}, {0, 1, 0}, {-1, 1, 0}, {-1, 0, 0}, -far, -far + Vector3d(0, 1, 0)};
    sheet.corners = {{0, 1, 2}, {0, 2, 3}, {0, 4, 5}, {0, 5, 1}};
    return sheet;
}

TEST(ThickenedSheet, AFlatSheetBecomesAPlateOfThatThicknessAboutIt) {
    const Surface plate = thickened(test::sheet_of_many(0.3, 0.2, 5), 0.001);
    require_sound_surface(plate);
    EXPECT_NEAR(test::moments_of(plate).volume, 0.3 * 0.2 * 0.001, 1e-12);
    EXPECT_LT(test::moments_of(plate).centroid.norm(), 1e-9);
    EXPECT_NEAR(surface_area(plate), 2.0 * 0.3 * 0.2 + 2.0 * (0.3 + 0.2) * 0.001, 1e-12);
}

TEST(ThickenedSheet, AFoldedSheetKeepsTheThicknessOfItsFaces) {
    const Surface plate = thickened(folded(std::numbers::pi / 3.0), 0.01);
    require_sound_surface(plate);
    // Either side's layers are mitred at the fold: their volumes are exact.
    EXPECT_NEAR(test::moments_of(plate).volume, 2.0 * 0.01, 1e-9);
}

TEST(ThickenedSheet, FacesOrientedEitherWayGiveTheSameSolid) {
    Surface sheet = test::sheet_of_many(0.3, 0.2, 3);
    const double volume = test::moments_of(thickened(sheet, 0.002)).volume;
    for (std::size_t t = 0; t < sheet.triangle_count(); t += 3) reverse_triangle(sheet, t);
    const Surface plate = thickened(sheet, 0.002);
    require_sound_surface(plate);
    EXPECT_NEAR(test::moments_of(plate).volume, volume, 1e-15);
}

TEST(ThickenedSheet, AnOpenTubeGetsTwoRims) {
    Surface tube;
    constexpr int n = 48;
    for (int i = 0; i < n; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / n;
        tube.vertices.emplace_back(std::cos(angle), std::sin(angle), 0.0);
        tube.vertices.emplace_back(std::cos(angle), std::sin(angle), 2.0);
        const std::int32_t a = 2 * i;
        const std::int32_t b = 2 * ((i + 1) % n);
        tube.corners.push_back({a, b, b + 1});
        tube.corners.push_back({a, b + 1, a + 1});
    }
    const Surface wall = thickened(tube, 0.02);
    require_sound_surface(wall);
    EXPECT_NEAR(test::moments_of(wall).volume, 0.02 * 2.0 * 2.0 * n * std::sin(std::numbers::pi / n), 1e-4);
}

TEST(ThickenedSheet, RefusesWhatIsNoSheet) {
    const auto error = [](const Surface& surface, double thickness) {
        return test::error_of([&] { thickened(surface, thickness); });
    };
    EXPECT_THAT(error(test::box({1, 1, 1}, 1), 0.01),
                HasSubstr("is closed already; leave the thickness out"));
    EXPECT_THAT(error(test::sheet(1.0, 1.0), 0.5), HasSubstr("check the unit"));
    Surface crowded = folded(1.0);
    crowded.vertices.emplace_back(0.0, 0.5, -1.0);
    crowded.corners.push_back({0, 6, 1});
    EXPECT_THAT(error(crowded, 0.01), HasSubstr("has 3 faces"));
    // A strip of seven triangles whose ends are joined with half a turn.
    Surface strip;
    constexpr int n = 8;
    for (int i = 0; i < n; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / n;
        const double turn = 0.5 * angle;
        const Vector3d out(std::cos(angle), std::sin(angle), 0.0);
        const Vector3d across = 0.3 * (std::cos(turn) * out + std::sin(turn) * Vector3d::UnitZ());
        strip.vertices.emplace_back(out - across);
        strip.vertices.emplace_back(out + across);
        const bool last = i == n - 1;
        const std::int32_t a = 2 * i;
        const std::int32_t b = last ? 1 : a + 2;
        const std::int32_t c = last ? 0 : a + 3;
        strip.corners.push_back({a, b, c});
        strip.corners.push_back({a, c, a + 1});
    }
    EXPECT_THAT(error(strip, 0.01), HasSubstr("one side only"));
}

}  // namespace
}  // namespace samara
